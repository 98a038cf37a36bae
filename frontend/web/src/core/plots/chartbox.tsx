import { effect, type ReadonlySignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type uPlot from "uplot";
import type { Trace } from "./definitions";
import { addDrawing } from "./frame";
import type { PlotSetup } from "./setups";
import { fillHost } from "./staticchart";

interface DrawnChart {
  plot: uPlot;
  draw(): void;
  hide(keys: ReadonlySet<string>): void;
}

interface ChartBoxProps {
  class: string;
  make: (host: HTMLElement, setup: PlotSetup, traces: readonly Trace[]) => DrawnChart;
  setup: PlotSetup;
  traces: readonly Trace[];
  hidden: ReadonlySignal<ReadonlySet<string>>;
}

/**
 * A chart in its host element: created again if the curves change, drawn by the clock of all plots.
 */
export function ChartBox({ class: look, make, setup, traces, hidden }: ChartBoxProps) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    const chart = make(element, setup, traces);
    const drawing = addDrawing(() => chart.draw());
    const stopHiding = effect(() => {
      chart.hide(hidden.value);
      drawing.redraw();
    });
    const resizing = new ResizeObserver(() => {
      fillHost(chart.plot, element);
      drawing.redraw();
    });
    const seeing = new IntersectionObserver((entries) =>
      drawing.setVisible(entries.at(-1)?.isIntersecting ?? true),
    );
    resizing.observe(element);
    seeing.observe(element);
    return () => {
      stopHiding();
      drawing.remove();
      resizing.disconnect();
      seeing.disconnect();
      chart.plot.destroy();
    };
  }, [make, setup, traces]);
  return <div class={look} ref={host} />;
}
