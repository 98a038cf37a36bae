import { useEffect, useRef } from "preact/hooks";
import { session } from "../state/session";
import { text } from "../text/en";
import { hasZoomed, zoomedEvent, zoomedSpan } from "./eventzoom";
import { onFrame } from "./frame";
import { drawTicks } from "./timeaxis";

/** What the zoom beside the plots is of. */
export function ZoomTitle() {
  void session.value;
  const event = zoomedEvent.value;
  if (event === null) return <p class="zoom-title">{text.zoom.none}</p>;
  const words = text.zoom.title(event.time_s.toFixed(2), event.label);
  return (
    <p class="zoom-title" title={words}>
      {hasZoomed() ? words : text.zoom.gone}
    </p>
  );
}

/** The axis of time below the zooms. */
export function ZoomAxis() {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const draw = () => canvas.current && drawTicks(canvas.current, zoomedSpan());
    const stop = onFrame(draw);
    const resizing = new ResizeObserver(draw);
    if (canvas.current) resizing.observe(canvas.current);
    return () => {
      stop();
      resizing.disconnect();
    };
  }, []);
  return <canvas class="zoom-axis" ref={canvas} />;
}
