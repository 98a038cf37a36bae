/**
 * The 3D view and the plots share the frames of the page. Where drawing the view takes long, as
 * with rendering in software, it lets some frames pass, so that the plots keep moving.
 */

/** What the plots are to have, ms a frame on average. */
const AIM_MS = 50;
/** The view is drawn twice a second at least. */
const LONGEST_MS = 500;
const NEWEST = 0.25;
const LONGEST_FRAME_MS = 1000;

/** How many frames the view lets pass, given what a frame takes with it and without it, ms. */
export function framesToPass(withView: number, without: number): number {
  if (withView <= AIM_MS) return 0;
  const room = Math.max(1, AIM_MS - without);
  const wanted = Math.ceil((withView - AIM_MS) / room);
  const most = Math.max(1, Math.floor((LONGEST_MS - withView) / without));
  return Math.min(wanted, most);
}

/** Gives a window's animation the frames that are left for it; all of them while it is handled. */
function pace(view: Window): void {
  const requestFrame = view.requestAnimationFrame.bind(view);
  const waiting = new Map<number, FrameRequestCallback>();
  const lapses = { withView: 0, without: 0 };
  let isHandled = false;
  let isLooping = false;
  let hadView = false;
  let toPass = 0;
  let lastId = 0;
  let frameAt = 0;

  const measure = (now: number) => {
    const lapse = Math.min(LONGEST_FRAME_MS, now - frameAt);
    const kind = hadView ? "withView" : "without";
    lapses[kind] += NEWEST * (lapse - lapses[kind]);
    frameAt = now;
  };
  const loop = (now: number) => {
    measure(now);
    isLooping = waiting.size > 0;
    if (isLooping) requestFrame(loop);
    hadView = isHandled || toPass <= 0;
    if (!hadView) {
      toPass--;
      return;
    }
    toPass = framesToPass(lapses.withView, lapses.without);
    const callbacks = [...waiting.values()];
    waiting.clear();
    for (const callback of callbacks) callback(now);
  };
  view.requestAnimationFrame = (callback) => {
    waiting.set(++lastId, callback);
    if (!isLooping) requestFrame(loop);
    isLooping = true;
    return lastId;
  };
  view.cancelAnimationFrame = (id) => {
    waiting.delete(id);
  };
  view.addEventListener("pointerdown", () => {
    isHandled = true;
  });
  for (const end of ["pointerup", "pointercancel"]) {
    view.addEventListener(end, () => {
      isHandled = false;
    });
  }
}

/** Paces every view that is loaded into a frame of this page. */
export function paceViews(): void {
  document.addEventListener(
    "load",
    ({ target }) => {
      if (target instanceof HTMLIFrameElement && target.contentWindow) pace(target.contentWindow);
    },
    true,
  );
}
