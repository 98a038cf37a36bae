import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { palette } from "./palette";
import { StaticChart, type StaticContent } from "./staticchart";

/**
 * A static chart in the host whose ref is returned: made anew for another content, which its owner
 * keeps; `watch` is called with each and returns what ends it.
 */
export function useStaticChart(
  content: StaticContent,
  hidden: ReadonlySet<string>,
  watch?: (chart: StaticChart) => () => void,
) {
  const host = useRef<HTMLDivElement>(null);
  const chart = useRef<StaticChart | null>(null);
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    const made = new StaticChart(element, content);
    chart.current = made;
    const ends = [
      effect(() => {
        void content.span.value;
        made.showSpan();
      }),
      effect(() => {
        void palette.value;
        made.plot.redraw(false);
      }),
      ...(watch ? [watch(made)] : []),
    ];
    const observer = new ResizeObserver(() => {
      made.resize(element.clientWidth, element.clientHeight);
    });
    observer.observe(element);
    return () => {
      for (const end of ends) end();
      observer.disconnect();
      made.plot.destroy();
      chart.current = null;
    };
  }, [content]);
  useEffect(() => chart.current?.hide(hidden), [content, hidden]);
  return host;
}
