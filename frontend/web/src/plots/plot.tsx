import { useEffect, useRef, useState } from "preact/hooks";
import { formatNumber } from "../units";
import { Chart, type ChartPlace } from "./chart";
import type { PlotDefinition } from "./definitions";
import { onFrame, redraw } from "./frame";
import { Legend } from "./legend";

const READING_MS = 120;

function writeReadings(
  chart: Chart,
  definition: PlotDefinition,
  readings: Map<string, HTMLElement>,
): void {
  definition.traces.forEach((trace, index) => {
    const element = readings.get(trace.channel);
    if (element) element.textContent = formatNumber(chart.reading(index), 3, 3);
  });
}

function useChart(definition: PlotDefinition, place: ChartPlace) {
  const host = useRef<HTMLDivElement>(null);
  const chart = useRef<Chart | null>(null);
  const readings = useRef(new Map<string, HTMLElement>());
  const { isFirst, isLast } = place;
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    let readAt = 0;
    const read = () => {
      if (chart.current) writeReadings(chart.current, definition, readings.current);
      readAt = performance.now();
    };
    const made = new Chart(element, definition, { isFirst, isLast }, read);
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
  }, [definition, isFirst, isLast]);
  return { host, chart, readings };
}

export function Plot({ definition, ...place }: { definition: PlotDefinition } & ChartPlace) {
  const { host, chart, readings } = useChart(definition, place);
  const [hidden, setHidden] = useState<ReadonlySet<string>>(new Set());

  const toggle = (channel: string) => {
    const next = new Set(hidden);
    if (!next.delete(channel)) next.add(channel);
    setHidden(next);
    definition.traces.forEach((trace, index) => {
      chart.current?.show(index, !next.has(trace.follows ?? trace.channel));
    });
  };

  return (
    <section class="plot" aria-label={definition.title} data-plot={definition.key}>
      <Legend definition={definition} hidden={hidden} readings={readings} onToggle={toggle} />
      <div class="plot-canvas" ref={host} />
    </section>
  );
}
