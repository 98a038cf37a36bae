import { effect } from "@preact/signals";
import type { RefObject } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import type { RunEvent } from "../plots/eventlines";
import { palette } from "../plots/palette";
import { text } from "../text/replay";
import { formatNumber } from "../units";
import { Chart, type ChartContent } from "./chart";
import { range, timeS } from "./clock";
import type { Curve, ReplayPlot } from "./curves";

export interface PlotProps {
  plot: ReplayPlot;
  time: Float64Array;
  events: readonly RunEvent[];
  isFirst: boolean;
  isLast: boolean;
}

export function Swatch({ curve }: { curve: Pick<Curve, "colour" | "dash" | "width"> }) {
  return (
    <svg class={`swatch ink-${curve.colour}`} viewBox="0 0 22 6" aria-hidden="true">
      <path
        d="M0 3h22"
        stroke-width={curve.width}
        stroke-dasharray={curve.dash.map((length) => length * 0.8).join(" ") || undefined}
      />
    </svg>
  );
}

function useChart(props: PlotProps, curves: Curve[], hidden: ReadonlySet<string>) {
  const host = useRef<HTMLDivElement>(null);
  const chart = useRef<Chart | null>(null);
  const readings = useRef(new Map<string, HTMLElement>());
  const { plot, time, events, isFirst, isLast } = props;
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    const content: ChartContent = { time, curves, span: plot.span, events, isFirst, isLast };
    let made: Chart | null = null;
    const read = () => {
      curves.forEach((curve, index) => {
        const output = readings.current.get(curve.key);
        if (output && made) output.textContent = formatNumber(made.reading(index), 3, 3);
      });
    };
    made = new Chart(element, content, read);
    const shown = made;
    chart.current = shown;
    const ends = [
      effect(() => {
        void timeS.value;
        shown.showTime();
        read();
      }),
      effect(() => {
        void range.value;
        shown.showRange();
      }),
      effect(() => {
        void palette.value;
        shown.redraw();
      }),
    ];
    const observer = new ResizeObserver(() => {
      shown.resize(element.clientWidth, element.clientHeight);
    });
    observer.observe(element);
    return () => {
      for (const end of ends) end();
      observer.disconnect();
      shown.destroy();
      chart.current = null;
    };
  }, [plot, curves, time, events, isFirst, isLast]);
  useEffect(() => {
    curves.forEach((curve, index) => {
      chart.current?.show(index, !hidden.has(curve.follows ?? curve.key));
    });
  }, [curves, hidden]);
  return { host, readings };
}

const isEntry = (curve: Curve) => curve.follows === undefined;

interface LegendProps {
  curves: Curve[];
  hidden: ReadonlySet<string>;
  readings: RefObject<Map<string, HTMLElement>>;
  onToggle: (key: string) => void;
}

/** One entry a curve with its value; a group of curves has one entry, and no one value. */
function Legend({ curves, hidden, readings, onToggle }: LegendProps) {
  const leaders = new Set(curves.map((curve) => curve.follows));
  return (
    <div class="legend">
      {curves.filter(isEntry).map((curve) => (
        <button
          key={curve.key}
          type="button"
          class="legend-entry"
          aria-pressed={!hidden.has(curve.key)}
          title={text.plots.toggle(curve.label)}
          onClick={() => onToggle(curve.key)}
        >
          <Swatch curve={curve} />
          <span class="legend-name">{curve.label}</span>
          {!leaders.has(curve.key) && (
            <output
              ref={(element) => {
                if (element) readings.current?.set(curve.key, element);
              }}
            />
          )}
        </button>
      ))}
    </div>
  );
}

export function Plot(props: PlotProps) {
  const { plot } = props;
  const [chosen, choose] = useState(0);
  const [hidden, setHidden] = useState<ReadonlySet<string>>(new Set());
  const { curves } = plot.choices[chosen] as ReplayPlot["choices"][number];
  const { host, readings } = useChart(props, curves, hidden);

  const toggle = (key: string) => {
    const next = new Set(hidden);
    if (!next.delete(key)) next.add(key);
    setHidden(next);
  };

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
        <Legend curves={curves} hidden={hidden} readings={readings} onToggle={toggle} />
      </div>
      <div class="plot-canvas" ref={host} title={props.isFirst ? text.plots.hint : undefined} />
    </section>
  );
}
