/**
 * The 3D view and the plots share the frames of the page. If drawing the view is slow, as with
 * software rendering, the view skips frames so that the plots stay smooth.
 */

/** Target for the plots, ms per frame on average. */
const TARGET_MS = 50;
/** The view is drawn at least twice per second. */
const MAX_VIEW_INTERVAL_MS = 500;
const AVERAGE_WEIGHT = 0.25;
const MAX_FRAME_MS = 1000;

/** Number of frames that the view skips, from the frame times with and without it, ms. */
export function framesToSkip(withView: number, withoutView: number): number {
  if (withView <= TARGET_MS) return 0;
  const slackMs = Math.max(1, TARGET_MS - withoutView);
  const required = Math.ceil((withView - TARGET_MS) / slackMs);
  const maximum = Math.max(1, Math.floor((MAX_VIEW_INTERVAL_MS - withView) / withoutView));
  return Math.min(required, maximum);
}

/** Give the animation of a window the remaining frames; all frames while the user operates it. */
function throttleView(view: Window): void {
  const requestFrame = view.requestAnimationFrame.bind(view);
  const waiting = new Map<number, FrameRequestCallback>();
  const averageMs = { withView: 0, without: 0 };
  let isPointerDown = false;
  let isLoopActive = false;
  let isViewDrawn = false;
  let toSkip = 0;
  let lastId = 0;
  let frameAt = 0;

  const measure = (now: number) => {
    const frameMs = Math.min(MAX_FRAME_MS, now - frameAt);
    const kind = isViewDrawn ? "withView" : "without";
    averageMs[kind] += AVERAGE_WEIGHT * (frameMs - averageMs[kind]);
    frameAt = now;
  };
  const loop = (now: number) => {
    measure(now);
    isLoopActive = waiting.size > 0;
    if (isLoopActive) requestFrame(loop);
    isViewDrawn = isPointerDown || toSkip <= 0;
    if (!isViewDrawn) {
      toSkip--;
      return;
    }
    toSkip = framesToSkip(averageMs.withView, averageMs.without);
    const callbacks = [...waiting.values()];
    waiting.clear();
    for (const callback of callbacks) callback(now);
  };
  view.requestAnimationFrame = (callback) => {
    waiting.set(++lastId, callback);
    if (!isLoopActive) requestFrame(loop);
    isLoopActive = true;
    return lastId;
  };
  view.cancelAnimationFrame = (id) => {
    waiting.delete(id);
  };
  view.addEventListener("pointerdown", () => {
    isPointerDown = true;
  });
  for (const end of ["pointerup", "pointercancel"]) {
    view.addEventListener(end, () => {
      isPointerDown = false;
    });
  }
}

/** Pace every view that is loaded into a frame of this page. */
export function throttleViews(): void {
  document.addEventListener(
    "load",
    ({ target }) => {
      if (target instanceof HTMLIFrameElement && target.contentWindow)
        throttleView(target.contentWindow);
    },
    true,
  );
}
