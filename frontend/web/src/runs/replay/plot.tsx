import { effect } from "@preact/signals";
import { useMemo, useRef, useState } from "preact/hooks";
import type uPlot from "uplot";
import { drawEventLines, eventsInView, type RunEvent } from "../../core/plots/eventlines";
import { Legend, useHidden } from "../../core/plots/legend";
import { palette } from "../../core/plots/linestyles";
import { describeTimeChart, type TimeChart, useStaticChart } from "../../core/plots/staticchart";
import { hasOneValue, hasUnnamedTruth, noteOfStiffness } from "../../core/plots/traces";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { range, seek, showAll, showRange, timeS } from "./clock";
import type { Curve, ReplayPlot } from "./curves";

const X_AXIS_PX = 24;
const LABELS_PX = 17;

interface PlotProps {
  plot: ReplayPlot;
  time: Float64Array;
  events: readonly RunEvent[];
  isFirst: boolean;
  isLast: boolean;
  isBench: boolean;
}

/** The chart in its host element, and the legend elements that show its values. */
function useChart(props: PlotProps, curves: readonly Curve[], hidden: TimeChart["hidden"]) {
  const { plot, time, events, isFirst, isLast } = props;
  const readings = useRef(new Map<string, HTMLElement>()).current;
  const chart = useMemo(() => {
    const read = (drawn: uPlot) => {
      const index = findSample(drawn);
      for (const { key, values, describe } of curves) {
        const output = readings.get(key);
        if (output) output.textContent = describe?.(index) ?? formatNumber(values[index], 3, 3);
      }
    };
    return describeTimeChart({
      time,
      curves,
      hidden,
      minSpan: plot.span,
      padding: [isFirst ? LABELS_PX : 8, 12, isLast ? 0 : 7, 0],
      timeAxis: {
        size: isLast ? X_AXIS_PX : 0,
        tick: (seconds: number) => t("plots.timeTick", { seconds: Number(seconds.toFixed(4)) }),
      },
      group: "replay",
      span: range,
      onSelect: (chosen) => (chosen ? showRange(chosen.from, chosen.to) : showAll()),
      drawBelow: (drawn) => drawEventLines(drawn, events),
      drawAbove: (drawn) => {
        if (isFirst) drawEventLabels(drawn, events);
        placeTimeLine(drawn);
      },
      onCursor: read,
      watch: (drawn) => {
        addTimeLine(drawn);
        drawn.over.addEventListener("click", ({ offsetX }) => seek(drawn.posToVal(offsetX, "x")));
        return effect(() => {
          void timeS.value;
          placeTimeLine(drawn);
          read(drawn);
        });
      },
    });
  }, [plot, curves, time, events, isFirst, isLast]);
  return { host: useStaticChart(chart), readings };
}

export function Plot(props: PlotProps) {
  const { plot } = props;
  const [chosen, choose] = useState(0);
  const [hidden, toggle] = useHidden();
  const { curves } = plot.choices[chosen] as ReplayPlot["choices"][number];
  const { host, readings } = useChart(props, curves, hidden);
  return (
    <section class="plot" aria-label={plot.title} data-plot={plot.key}>
      <div class="plot-head">
        <h3>
          {plot.title} <span class="unit">{plot.unit}</span>
        </h3>
        {plot.choices.length > 1 && (
          <fieldset class="choices" aria-label={t("replay.plots.choose", { title: plot.title })}>
            {plot.choices.map((choice, index) => (
              <label key={choice.label} class="chip">
                <input
                  type="radio"
                  name={plot.key}
                  checked={index === chosen}
                  onChange={() => choose(index)}
                />
                <span>{choice.label}</span>
              </label>
            ))}
          </fieldset>
        )}
        <Legend
          note={
            hasUnnamedTruth(curves)
              ? t("plots.disturbanceNote")
              : noteOfStiffness(curves, props.isBench)
          }
          entries={curves.filter((curve) => curve.follows === undefined)}
          hidden={hidden.value}
          onToggle={toggle}
          readings={readings}
          isRead={(key) => hasOneValue(curves, key)}
        />
      </div>
      <div
        class="plot-canvas"
        ref={host}
        title={props.isFirst ? t("replay.plots.hint") : undefined}
      />
    </section>
  );
}

// The current time of the replay on a plot: a line, and the values at it.

const LINE = "now";

function addTimeLine(plot: uPlot): void {
  const line = document.createElement("div");
  line.className = LINE;
  plot.over.append(line);
  placeTimeLine(plot);
}

function placeTimeLine(plot: uPlot): void {
  const line = plot.over.querySelector<HTMLElement>(`.${LINE}`);
  if (line === null) return;
  const { from, to } = range.peek();
  const time = timeS.peek();
  line.hidden = time < from || time > to;
  line.style.translate = `${plot.valToPos(time, "x").toFixed(2)}px`;
}

/** Index of the sample at the pointer, otherwise at the current time. */
function findSample({ data: [time], cursor }: uPlot): number {
  const step = (time[1] ?? 1) - (time[0] ?? 0);
  const now = Math.min(Math.round(timeS.peek() / step), time.length - 1);
  return cursor.idx ?? now;
}

// The labels of the run's events, above the first plot.

const LABEL_PX = 11;

/** Labels, each if there is space for it. */
function drawEventLabels(plot: uPlot, events: readonly RunEvent[]): void {
  const { ctx: context, bbox } = plot;
  const gap = 4 * devicePixelRatio;
  let free = 0;
  context.save();
  context.fillStyle = palette.peek().mark;
  context.font = `600 ${LABEL_PX * devicePixelRatio}px system-ui, sans-serif`;
  context.textAlign = "left";
  context.textBaseline = "bottom";
  for (const event of eventsInView(plot, events)) {
    const width = context.measureText(event.label).width;
    const x = plot.valToPos(event.time_s, "x", true) - gap;
    const left = Math.max(bbox.left, Math.min(x, bbox.left + bbox.width - width));
    if (left < free) continue;
    free = left + width + 2 * gap;
    context.fillText(event.label, left, bbox.top - 2 * devicePixelRatio);
  }
  context.restore();
}
