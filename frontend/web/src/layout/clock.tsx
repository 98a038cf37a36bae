import { samples } from "../core/state/session";
import { text } from "../core/text/en";
import { formatTime } from "../core/units";
import { useLiveText } from "../core/widgets/live";

const readTime = () => formatTime(samples.ring.newestTime || 0);

/** Session time of the newest sample. */
export function Clock() {
  const element = useLiveText<HTMLSpanElement>(readTime);
  return (
    <span class="clock" title={text.status.timeHint} role="timer" aria-label={text.status.time}>
      <span ref={element} />
    </span>
  );
}
