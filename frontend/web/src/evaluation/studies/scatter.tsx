import { effect } from "@preact/signals";
import { useMemo } from "preact/hooks";
import type uPlot from "uplot";
import { palette } from "../../core/plots/linestyles";
import { useStaticChart } from "../../core/plots/staticchart";
import { t } from "../../core/text/t";
import { NumberField } from "../../core/widgets/numberinput";
import { paintDots } from "./dots";
import {
  brushedCount,
  endedInFault,
  lawIndices,
  lawLineStyles,
  planes,
  shownMarks,
  succeeded,
} from "./drawnrows";
import { describePlane, showBrush } from "./frame";
import { findNearest } from "./points";
import { valuesOf } from "./rows";
import { selectRow } from "./selectedruns";
import { axes, brush, chosenName, selectedRows, setBrush, setView, study } from "./selection";
import { fetchRows, rows } from "./studies";
import { axesOf, nameColumn, type Plane } from "./studyview";

const REACH_PX = 14;

export function ColumnChoice({
  part,
  label,
  isMetric,
}: {
  part: string;
  label: string;
  isMetric?: boolean;
}) {
  const columns = study.value?.columns ?? [];
  const offered = isMetric ? columns.filter(({ role }) => role === "metric") : axesOf(columns);
  return (
    <label class="form">
      <span>{label}</span>
      <select
        value={axes.value[part]}
        onChange={(event) => {
          const held = brush.peek();
          setView({
            [part]: event.currentTarget.value,
            ...(held !== null && part.startsWith(held.plane) && { brush: "" }),
          });
          void fetchRows(chosenName.peek());
        }}
      >
        {offered.map((column) => (
          <option key={column.name} value={column.name}>
            {nameColumn(column)}
          </option>
        ))}
      </select>
    </label>
  );
}

/** Number fields for the edges of the brush, for keyboard users. */
function Ends({ plane }: { plane: Plane }) {
  const held = brush.value?.plane === plane ? brush.value : null;
  const { across, up } = planes[plane].value;
  const set = async (way: "x" | "y", end: 0 | 1, value: number) => {
    const now = held ?? { plane, x: across.span, y: up.span };
    const span: [number, number] = [...now[way]];
    span[end] = value;
    setBrush({ ...now, plane, [way]: span });
    return true;
  };
  return (
    <div class="form cells" style={{ "--cell": "90px" }}>
      {(["x", "y"] as const).map((way) => {
        const axis = way === "x" ? t("studies.x") : t("studies.y");
        return ([0, 1] as const).map((end) => (
          <NumberField
            key={`${way}${end}`}
            label={end === 0 ? t("studies.from", { axis }) : t("studies.to", { axis })}
            value={held === null ? null : held[way][end]}
            digits={4}
            onCommit={(value) => set(way, end, value)}
            onEmpty={() => undefined}
          />
        ));
      })}
    </div>
  );
}

const nextRow = (step: number): number | null => {
  const numbers = valuesOf(rows.peek(), "row");
  const inBrush = shownMarks.peek();
  const at = numbers.indexOf(Number(selectedRows.peek().at(-1)?.row ?? -1));
  for (let moved = 1; moved <= numbers.length; moved++) {
    const index = (at + step * moved + 2 * numbers.length) % numbers.length;
    if (inBrush[index] === 1) return numbers[index] as number;
  }
  return null;
};

function onKey(event: KeyboardEvent): void {
  const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  if (event.key === "Escape") setBrush(null);
  else if (step === undefined) return;
  else {
    const row = nextRow(step);
    if (row !== null) void selectRow(row);
  }
  event.preventDefault();
}

/** Any two columns, one dot per run; the brush applies to all views. */
export function Scatter({ plane }: { plane: Plane }) {
  const { x, y, across, up } = planes[plane].value;
  const chart = useMemo(
    () =>
      describePlane({
        x: across,
        y: up,
        paint: (plot) => {
          const colours = lawLineStyles.peek().map(({ colour }) => palette.peek()[colour]);
          paintDots(plot, {
            x,
            y,
            lineStyles: lawIndices.peek(),
            good: succeeded.peek(),
            ended: endedInFault.peek(),
            marks: shownMarks.peek(),
            colours,
            faint: palette.peek().axis,
          });
          circlePicked(plot, x, y);
        },
        onBrush: (drawn) => setBrush({ ...drawn, plane }),
        onPick: (plot, left, top) => {
          const place = (at: number, height: number) =>
            [plot.valToPos(at, "x"), plot.valToPos(height, "y")] as const;
          const nearest = findNearest(x, y, shownMarks.peek(), place, [left, top], REACH_PX);
          if (nearest !== null) void selectRow(valuesOf(rows.peek(), "row")[nearest] as number);
          else if (brush.peek() !== null) setBrush(null);
        },
        watch: (plot) =>
          effect(() => {
            void [lawLineStyles.value, shownMarks.value, selectedRows.value, succeeded.value];
            showBrush(plot, brush.value?.plane === plane ? brush.value : null);
          }),
      }),
    [x, y, plane],
  );
  const host = useStaticChart(chart);
  const missing = x.reduce(
    (sum, value, at) => sum + (Number.isNaN(value + (y[at] ?? 0)) ? 1 : 0),
    0,
  );
  return (
    <section class="surface card" aria-label={t(`studies.plane.${plane}`)}>
      <div class="pair form">
        <ColumnChoice part={`${plane}y`} label={t("studies.y")} />
        <ColumnChoice part={`${plane}x`} label={t("studies.x")} />
      </div>
      <div
        class="studies-canvas"
        ref={host}
        role="application"
        // biome-ignore lint/a11y/noNoninteractiveTabindex: arrow keys move from dot to dot
        tabIndex={0}
        aria-label={t("studies.dotsLabel", {
          y: up.label,
          x: across.label,
          count: brushedCount.value,
        })}
        title={t("studies.dotsHint")}
        onKeyDown={onKey}
      />
      <Ends plane={plane} />
      {missing > 0 && <p class="hint">{t("studies.missing", { count: missing })}</p>}
    </section>
  );
}

function circlePicked(plot: uPlot, x: Float64Array, y: Float64Array): void {
  const numbers = valuesOf(rows.peek(), "row");
  for (const { row } of selectedRows.peek()) {
    const index = numbers.indexOf(Number(row));
    if (index < 0) continue;
    const [left, top] = [
      plot.valToPos(x[index] as number, "x", true),
      plot.valToPos(y[index] as number, "y", true),
    ];
    plot.ctx.save();
    plot.ctx.strokeStyle = palette.peek().reference;
    plot.ctx.lineWidth = 2 * devicePixelRatio;
    plot.ctx.beginPath();
    plot.ctx.arc(left, top, 7 * devicePixelRatio, 0, 2 * Math.PI);
    plot.ctx.stroke();
    plot.ctx.restore();
  }
}
