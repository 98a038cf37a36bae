/** How high a plot is in a list that shows whole plots only: those beyond are scrolled to. */

/** The events above the plots, and the axis of time below them. */
const TOP_PX = 22;
export const FOOT_PX = 24;
/** A plot's title and legend. */
const HEAD_PX = 26;

/** So far the last plot reaches under the axis: no hair of the next one is seen above it. */
const UNDER_PX = 1;

/**
 * The height of a plot, head included, px: as many as have room share the list, each picture at least
 * so high.
 */
export function shareOfList(height: number, leastPicture: number): number {
  const room = height - TOP_PX - FOOT_PX;
  const together = Math.max(1, Math.floor(room / (leastPicture + HEAD_PX)));
  return Math.max(0, (room + UNDER_PX) / together);
}

/** Keeps `--plot-share` of the list; returns the function that ends it. */
export function keepShare(list: HTMLElement): () => void {
  const measure = () => {
    const least = Number.parseFloat(getComputedStyle(list).getPropertyValue("--least-plot"));
    list.style.setProperty("--plot-share", `${shareOfList(list.clientHeight, least)}px`);
  };
  const resizing = new ResizeObserver(measure);
  resizing.observe(list);
  return () => resizing.disconnect();
}
