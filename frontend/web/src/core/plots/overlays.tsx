import { useEffect, useRef } from "preact/hooks";
import { text } from "../text/en";
import { onFrame } from "./frame";
import { hoverShare, hoverTime } from "./hover";

/** The line under the pointer, over all plots, with its time, which goes on where the plots do. */
export function HoverLine() {
  const line = useRef<HTMLDivElement>(null);
  const words = useRef<HTMLSpanElement>(null);
  useEffect(() => {
    const show = () => {
      const time = hoverTime();
      if (line.current === null || words.current === null) return;
      line.current.hidden = time === null;
      line.current.style.left = `${(hoverShare.peek() ?? 0) * 100}%`;
      const next = time === null ? "" : text.plots.hovered(time.toFixed(2));
      if (words.current.textContent !== next) words.current.textContent = next;
    };
    const stopHover = hoverShare.subscribe(show);
    const stopFrames = onFrame(show);
    return () => {
      stopHover();
      stopFrames();
    };
  }, []);
  return (
    <div class="hover-line" ref={line} hidden>
      <span ref={words} />
    </div>
  );
}
