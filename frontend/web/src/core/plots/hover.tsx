/** The time under the pointer, the same in all plots. */

import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { t } from "../text/t";
import { formatFixed } from "../units";
import { onFrame } from "./frame";
import { shownRing, shownSpan } from "./span";

/** Position of the pointer on the axis, 0 to 1; null if it is not over a plot. */
export const hoverShare = signal<number | null>(null);

/** Time under the pointer, s; null if it is not over a plot. */
function hoverTime(): number | null {
  const share = hoverShare.peek();
  if (share === null) return null;
  const { from, to } = shownSpan();
  return from + share * (to - from);
}

/** Index of the sample that is read: under the pointer, or the newest on screen; -1: none. */
export function sampleRead(): number {
  const ring = shownRing();
  const time = hoverTime();
  return time === null ? ring.nearestTo(shownSpan().to) : ring.sampleAt(time);
}

/** The line under the pointer, over all plots, with its time, which advances with live plots. */
export function HoverLine() {
  const line = useRef<HTMLDivElement>(null);
  const words = useRef<HTMLSpanElement>(null);
  useEffect(() => {
    const show = () => {
      const time = hoverTime();
      if (line.current === null || words.current === null) return;
      line.current.hidden = time === null;
      line.current.style.left = `${(hoverShare.peek() ?? 0) * 100}%`;
      const next = time === null ? "" : t("plots.hovered", { seconds: formatFixed(time, 2) });
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
      <span class="tiny muted tabular nowrap" ref={words} />
    </div>
  );
}
