import { useEffect, useRef, useState } from "preact/hooks";
import { text } from "../text/en";
import { formatNumber } from "../units";
import { Chart, type ChartPlace } from "./chart";
import type { PlotChoice, PlotDefinition, Trace } from "./definitions";
import { onFrame, redraw } from "./frame";
import { Legend } from "./legend";

const READING_MS = 120;

function writeReadings(
  chart: Chart,
  traces: readonly Trace[],
  readings: Map<string, HTMLElement>,
): void {
  traces.forEach((trace, index) => {
    const element = readings.get(trace.key);
    if (element) element.textContent = formatNumber(chart.reading(index), 3, 3);
  });
}

function useChart(definition: PlotDefinition, choice: PlotChoice, place: ChartPlace) {
  const host = useRef<HTMLDivElement>(null);
  const chart = useRef<Chart | null>(null);
  const readings = useRef(new Map<string, HTMLElement>());
  const { isFirst, isLast } = place;
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    let readAt = 0;
    const read = () => {
      if (chart.current) writeReadings(chart.current, choice.traces, readings.current);
      readAt = performance.now();
    };
    const made = new Chart(element, definition, choice, { isFirst, isLast }, read);
    chart.current = made;
    const stop = onFrame((view) => {
      made.draw(view);
      if (performance.now() - readAt > READING_MS) read();
    });
    const observer = new ResizeObserver(() => {
      made.resize(element.clientWidth, element.clientHeight);
      redraw();
    });
    observer.observe(element);
    return () => {
      stop();
      observer.disconnect();
      made.destroy();
      chart.current = null;
    };
  }, [definition, choice, isFirst, isLast]);
  return { host, chart, readings };
}

interface ChooserProps {
  definition: PlotDefinition;
  chosen: number;
  onChoose: (index: number) => void;
}

function Chooser({ definition, chosen, onChoose }: ChooserProps) {
  return (
    <fieldset class="choices" aria-label={text.plots.choose(definition.title)}>
      {definition.choices.map((choice, index) => (
        <label key={choice.label} class="chip">
          <input
            type="radio"
            name={`plot.${definition.key}`}
            checked={index === chosen}
            onChange={() => onChoose(index)}
          />
          <span>{choice.label}</span>
        </label>
      ))}
    </fieldset>
  );
}

export function Plot({ definition, ...place }: { definition: PlotDefinition } & ChartPlace) {
  const [chosen, setChosen] = useState(0);
  const [hidden, setHidden] = useState<ReadonlySet<string>>(new Set());
  const choice = definition.choices[chosen] as PlotChoice;
  const { host, chart, readings } = useChart(definition, choice, place);

  const toggle = (key: string) => {
    const next = new Set(hidden);
    if (!next.delete(key)) next.add(key);
    setHidden(next);
    choice.traces.forEach((trace, index) => {
      chart.current?.show(index, !next.has(trace.follows ?? trace.key));
    });
  };
  const choose = (index: number) => {
    setHidden(new Set());
    setChosen(index);
  };

  return (
    <section class="plot" aria-label={definition.title} data-plot={definition.key}>
      <div class="plot-head">
        <h3>
          {definition.title} <span class="unit">{definition.unit}</span>
        </h3>
        {definition.choices.length > 1 && (
          <Chooser definition={definition} chosen={chosen} onChoose={choose} />
        )}
        <Legend
          note={definition.note}
          traces={choice.traces}
          hidden={hidden}
          readings={readings}
          onToggle={toggle}
        />
      </div>
      <div class="plot-canvas" ref={host} />
    </section>
  );
}
