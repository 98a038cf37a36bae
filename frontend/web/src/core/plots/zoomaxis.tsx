import { session } from "../state/session";
import { text } from "../text/en";
import { hasZoomed, zoomedEvent, zoomedSpan } from "./eventzoom";
import { useTicks } from "./timeaxis";

/** What the zoom beside the plots is of. */
export function ZoomTitle() {
  void session.value;
  const event = zoomedEvent.value;
  const words = event && text.zoom.title(event.time_s.toFixed(2), event.label);
  const told = words === null ? text.zoom.none : hasZoomed() ? words : text.zoom.gone;
  return (
    <p class="zoom-title" title={words ?? undefined}>
      <span>{told}</span>
    </p>
  );
}

/** The axis of time below the zooms. */
export function ZoomAxis() {
  return <canvas class="zoom-axis" ref={useTicks(zoomedSpan)} />;
}
