import { effect } from "@preact/signals";
import { useCallback, useMemo, useRef, useState } from "preact/hooks";
import type uPlot from "uplot";
import { drawEventLines, eventsInView, type RunEvent } from "../../core/plots/eventlines";
import { Legend, useHidden } from "../../core/plots/legend";
import { palette } from "../../core/plots/linestyles";
import { type StaticChart, type StaticContent, useStaticChart } from "../../core/plots/staticchart";
import { text } from "../../core/text/replay";
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
}

function describeChart(
  { plot, time, events, isFirst, isLast }: PlotProps,
  curves: readonly Curve[],
  onCursor: () => void,
): StaticContent {
  return {
    time,
    curves,
    minSpan: plot.span,
    padding: [isFirst ? LABELS_PX : 8, 12, isLast ? 0 : 7, 0],
    timeAxis: { size: isLast ? X_AXIS_PX : 0, tick: text.plots.timeTick },
    group: "replay",
    span: range,
    onSelect: (chosen) => (chosen ? showRange(chosen.from, chosen.to) : showAll()),
    drawBelow: (drawn) => drawEventLines(drawn, events),
    drawAbove: (drawn) => {
      if (isFirst) drawEventLabels(drawn, events);
      placeTimeLine(drawn);
    },
    onCursor,
  };
}

/** The chart in its host, and the elements of the legend that have its values. */
function useChart(props: PlotProps, curves: readonly Curve[], hidden: ReadonlySet<string>) {
  const { plot, time, events, isFirst, isLast } = props;
  const readings = useRef(new Map<string, HTMLElement>()).current;
  const shown = useRef<StaticChart | null>(null);
  const read = useCallback(() => {
    const chart = shown.current;
    for (const { key, values } of curves) {
      const output = readings.get(key);
      if (output && chart) output.textContent = formatNumber(readCurve(chart, values), 3, 3);
    }
  }, [curves]);
  const content = useMemo(
    () => describeChart(props, curves, read),
    [plot, curves, time, events, isFirst, isLast],
  );
  const host = useStaticChart(content, hidden, (chart) => {
    shown.current = chart;
    addTimeLine(chart);
    chart.plot.over.addEventListener("click", (event) => {
      seek(chart.plot.posToVal(event.offsetX, "x"));
    });
    return effect(() => {
      void timeS.value;
      placeTimeLine(chart.plot);
      read();
    });
  });
  return { host, readings };
}

export function Plot(props: PlotProps) {
  const { plot } = props;
  const [chosen, choose] = useState(0);
  const [hidden, toggle] = useHidden();
  const { curves } = plot.choices[chosen] as ReplayPlot["choices"][number];
  const { host, readings } = useChart(props, curves, hidden);
  const leaders = new Set(curves.map((curve) => curve.follows));

  return (
    <section class="plot" aria-label={plot.title} data-plot={plot.key}>
      <div class="plot-head">
        <h3>
          {plot.title} <span class="unit">{plot.unit}</span>
        </h3>
        {plot.choices.length > 1 && (
          <fieldset class="choices" aria-label={text.plots.choose(plot.title)}>
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
          entries={curves.filter((curve) => curve.follows === undefined)}
          hidden={hidden}
          onToggle={toggle}
          readings={readings}
          isRead={(key) => !leaders.has(key)}
        />
      </div>
      <div class="plot-canvas" ref={host} title={props.isFirst ? text.plots.hint : undefined} />
    </section>
  );
}

// The present time of the replay on a plot: a line, and the values there.

const LINE = "now";

function addTimeLine({ plot }: StaticChart): void {
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

/** Value of a curve at the pointer, or else at the present time. */
function readCurve({ plot, content }: StaticChart, values: Float32Array): number {
  const { time } = content;
  const step = (time[1] ?? 1) - (time[0] ?? 0);
  const now = Math.min(Math.round(timeS.peek() / step), time.length - 1);
  return values[plot.cursor.idx ?? now] ?? Number.NaN;
}

// The names of the run's events, above the first plot.

const LABEL_PX = 11;

/** Names, each where there is room left for it. */
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
