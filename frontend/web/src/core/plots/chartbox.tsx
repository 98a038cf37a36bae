import { useEffect, useRef } from "preact/hooks";
import type { Trace } from "./definitions";
import { addDrawing } from "./frame";
import type { PlotSetup } from "./setups";

interface DrawnChart {
  draw(): void;
  hide(keys: ReadonlySet<string>): void;
  resize(width: number, height: number): void;
  destroy(): void;
}

interface ChartBoxProps {
  class: string;
  make: (host: HTMLElement, setup: PlotSetup, traces: readonly Trace[]) => DrawnChart;
  setup: PlotSetup;
  traces: readonly Trace[];
  hidden: ReadonlySet<string>;
}

/** A chart in its host: made anew for other curves, drawn by the clock of all plots. */
export function ChartBox({ class: look, make, setup, traces, hidden }: ChartBoxProps) {
  const host = useRef<HTMLDivElement>(null);
  const hide = useRef<(keys: ReadonlySet<string>) => void>(() => undefined);
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    const chart = make(element, setup, traces);
    const drawing = addDrawing(() => chart.draw());
    hide.current = (keys) => {
      chart.hide(keys);
      drawing.renew();
    };
    const resizing = new ResizeObserver(() => {
      chart.resize(element.clientWidth, element.clientHeight);
      drawing.renew();
    });
    const seeing = new IntersectionObserver((entries) =>
      drawing.see(entries.at(-1)?.isIntersecting ?? true),
    );
    resizing.observe(element);
    seeing.observe(element);
    return () => {
      drawing.remove();
      resizing.disconnect();
      seeing.disconnect();
      chart.destroy();
    };
  }, [make, setup, traces]);
  useEffect(() => hide.current(hidden), [hidden, traces]);
  return <div class={look} ref={host} />;
}
