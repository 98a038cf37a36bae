import { useEffect, useRef } from "preact/hooks";
import { limitRate } from "../rate";
import { session } from "../state/session";
import { t } from "../text/t";
import { formatFixed } from "../units";
import { FONT, placeWords, timeStep } from "./axes";
import { mayHaveZoomedSamples, zoomedEvent, zoomedSpan } from "./eventzoom";
import { onFrame } from "./frame";
import { palette } from "./linestyles";
import { goLive, isFrozen, pan, shownRing, shownSpan, showSpan, zoom } from "./span";
import type { Span } from "./spans";

const PAN_SHARE = 0.1;
const ZOOM = 1.25;
const SHOWN_MS = 1000;

const KEYS: Readonly<Record<string, () => void>> = {
  ArrowLeft: () => pan(-PAN_SHARE),
  ArrowDown: () => pan(-PAN_SHARE),
  ArrowRight: () => pan(PAN_SHARE),
  ArrowUp: () => pan(PAN_SHARE),
  PageUp: () => pan(1),
  PageDown: () => pan(-1),
  "+": () => zoom(1 / ZOOM),
  "=": () => zoom(1 / ZOOM),
  "-": () => zoom(ZOOM),
  End: goLive,
  Home: () => {
    const { from, to } = shownSpan();
    const oldest = shownRing().oldestTime;
    showSpan({ from: oldest, to: oldest + to - from });
  },
};

/** Numbers of the axis at round times. */
function drawTicks(canvas: HTMLCanvasElement, { from, to }: Span): void {
  const context = canvas.getContext("2d");
  if (context === null) return;
  const ratio = devicePixelRatio;
  const { clientWidth, clientHeight } = canvas;
  const [width, height] = [Math.round(clientWidth * ratio), Math.round(clientHeight * ratio)];
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, clientWidth, clientHeight);
  context.font = FONT;
  context.fillStyle = palette.peek().axis;
  context.textBaseline = "middle";
  const step = timeStep({ from, to }, clientWidth);
  const perStep = (step / (to - from)) * clientWidth;
  for (let index = Math.ceil(from / step - 1e-9); index * step <= to + 1e-9; index++) {
    const x = ((index * step - from) / (to - from)) * clientWidth;
    const words = t("plots.timeTick", { seconds: Number((index * step).toFixed(4)) });
    const left = placeWords(x, context.measureText(words).width, clientWidth, perStep);
    if (left !== null) context.fillText(words, left, clientHeight / 2 + 1);
  }
}

/** A canvas with the numbers of a span, drawn with every frame. onDrawn: called after drawing. */
function useTicks(spanOf: () => Span, onDrawn: () => void = () => undefined) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const draw = () => {
      if (canvas.current) drawTicks(canvas.current, spanOf());
      onDrawn();
    };
    const stop = onFrame(draw);
    const resizing = new ResizeObserver(draw);
    if (canvas.current) resizing.observe(canvas.current);
    return () => {
      stop();
      resizing.disconnect();
    };
  }, []);
  return canvas;
}

/** The time axis below all plots: its numbers, and the keys that move and zoom. */
export function TimeAxis() {
  const axis = useRef<HTMLDivElement>(null);
  const publish = () => {
    const { from, to } = shownSpan();
    const value = t("plots.spanValue", { from: formatFixed(from, 2), to: formatFixed(to, 2) });
    axis.current?.setAttribute("aria-valuetext", value);
    axis.current?.setAttribute("aria-valuenow", to.toFixed(2));
    const { newestTime } = shownRing();
    const end = newestTime > to ? newestTime : to;
    axis.current?.setAttribute("aria-valuemax", end.toFixed(2));
  };
  const published = useRef(limitRate(publish, () => (isFrozen.peek() ? 0 : SHOWN_MS))).current;
  const canvas = useTicks(shownSpan, published.request);
  return (
    <div
      ref={axis}
      class="grab time-axis"
      role="slider"
      tabIndex={0}
      aria-label={t("plots.span")}
      aria-valuemin={0}
      aria-valuenow={0}
      title={t("plots.spanHint")}
      onKeyDown={(event) => {
        const answer = KEYS[event.key];
        if (answer === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        answer();
      }}
    >
      <canvas ref={canvas} />
    </div>
  );
}

/** The event of the zoom next to the plots. */
export function ZoomTitle() {
  void session.value;
  const event = zoomedEvent.value;
  const words =
    event && t("zoom.title", { time: formatFixed(event.time_s, 2), event: event.label });
  const label = words === null ? t("zoom.none") : mayHaveZoomedSamples() ? words : t("zoom.gone");
  return (
    <p class="muted tiny strong zoom-title" title={words ?? undefined}>
      <span>{label}</span>
    </p>
  );
}

/** The axis of time below the zooms. */
export function ZoomAxis() {
  return <canvas class="zoom-axis" ref={useTicks(zoomedSpan)} />;
}
