import { text } from "../text/en";
import { hoverShare } from "./hover";
import { shownSpan } from "./span";

/** The line under the pointer, over all plots, with its time. */
export function HoverLine() {
  const share = hoverShare.value;
  if (share === null) return null;
  const { from, to } = shownSpan();
  const time = from + share * (to - from);
  return (
    <div class="hover-line" style={{ left: `${share * 100}%` }}>
      <span>{text.plots.timeTick(Number(time.toFixed(2)))}</span>
    </div>
  );
}
