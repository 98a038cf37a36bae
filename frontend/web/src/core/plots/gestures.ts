/** Wheel and pointer over the plots: zoom, move, go live, and the time under the pointer. */
import { hoverShare } from "./hover";
import { freeze, goLive, pan, shownSpan, showSpan } from "./span";
import { type Span, zoomSpan } from "./spans";

const PER_WHEEL_PX = 0.0016;
const PER_WHEEL_LINE_PX = 24;
const DRAG_PX = 4;
const OVER_CURVES = ".plot:not(.is-phase) .plot-canvas, .time-axis";

/** Position of a pointer on the axis, 0 to 1; `box` is the area of the curves. */
export function shareAt(box: Element, clientX: number): number {
  const { left, width } = box.getBoundingClientRect();
  return (clientX - left) / Math.max(1, width);
}

const isOverCurves = (event: Event) =>
  event.target instanceof Element && event.target.closest(OVER_CURVES) !== null;

/**
 * @param box an element that covers exactly the area of the curves
 */
export function listenToGestures(stage: HTMLElement, box: HTMLElement): () => void {
  let drag: { x: number; span: Span; isMoving: boolean } | null = null;

  const showHover = (share: number | null) => {
    hoverShare.value = share;
    stage.toggleAttribute("data-hovered", share !== null);
  };
  const wheel = (event: WheelEvent) => {
    if (!isOverCurves(event) || event.ctrlKey) return;
    event.preventDefault();
    const unit = event.deltaMode === 0 ? 1 : PER_WHEEL_LINE_PX;
    const across = event.shiftKey ? event.deltaX || event.deltaY : event.deltaX;
    if (event.shiftKey || Math.abs(across) > Math.abs(event.deltaY)) {
      pan((across * unit) / box.clientWidth);
      return;
    }
    const span = shownSpan();
    const around = span.from + shareAt(box, event.clientX) * (span.to - span.from);
    showSpan(zoomSpan(span, Math.exp(event.deltaY * unit * PER_WHEEL_PX), around));
  };
  const down = (event: PointerEvent) => {
    if (!event.isPrimary || event.button !== 0 || !isOverCurves(event)) return;
    drag = { x: event.clientX, span: shownSpan(), isMoving: false };
  };
  const move = (event: PointerEvent) => {
    const share = shareAt(box, event.clientX);
    const isOver = event.pointerType === "mouse" && share >= 0 && share <= 1 && isOverCurves(event);
    showHover(isOver ? share : null);
    if (drag === null || !event.isPrimary) return;
    const by = event.clientX - drag.x;
    if (!drag.isMoving && Math.abs(by) < DRAG_PX) return;
    if (!drag.isMoving) {
      drag.isMoving = true;
      freeze();
      stage.setPointerCapture(event.pointerId);
    }
    const { from, to } = drag.span;
    const shift = (by / box.clientWidth) * (to - from);
    showSpan({ from: from - shift, to: to - shift });
  };
  const up = () => {
    drag = null;
  };
  const leave = () => showHover(null);
  const double = (event: MouseEvent) => {
    if (isOverCurves(event)) goLive();
  };

  stage.addEventListener("wheel", wheel, { passive: false });
  stage.addEventListener("pointerdown", down);
  stage.addEventListener("pointermove", move);
  stage.addEventListener("pointerup", up);
  stage.addEventListener("pointercancel", up);
  stage.addEventListener("pointerleave", leave);
  stage.addEventListener("dblclick", double);
  return () => {
    stage.removeEventListener("wheel", wheel);
    stage.removeEventListener("pointerdown", down);
    stage.removeEventListener("pointermove", move);
    stage.removeEventListener("pointerup", up);
    stage.removeEventListener("pointercancel", up);
    stage.removeEventListener("pointerleave", leave);
    stage.removeEventListener("dblclick", double);
  };
}
