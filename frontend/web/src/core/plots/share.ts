/** How high a plot is in a list that shows whole plots only: those beyond are scrolled to. */

/** The events above the plots, and the axis of time below them. */
const TOP_PX = 22;
export const FOOT_PX = 24;
/** A plot's title and legend, where the legend has one row. */
const HEAD_PX = 26;

/** So far the last plot reaches under the axis: no hair of the next one is seen above it. */
const UNDER_PX = 1;

/**
 * The height of a plot, head included, px: as many as have room share the list, each picture at least
 * so high. head: of the plot with the longest legend, px.
 */
export function shareOfList(height: number, leastPicture: number, head = HEAD_PX): number {
  const room = height - TOP_PX - FOOT_PX;
  const together = Math.max(1, Math.floor(room / (leastPicture + Math.max(HEAD_PX, head))));
  return Math.max(0, (room + UNDER_PX) / together);
}

/** Keeps `--plot-share` of a list with these plots; returns the function that ends it. */
export function keepShare(list: HTMLElement): () => void {
  const heads = [...list.querySelectorAll(".plots-stage > .plot > .plot-head")];
  const measure = () => {
    const least = Number.parseFloat(getComputedStyle(list).getPropertyValue("--least-plot"));
    const head = Math.max(0, ...heads.map((one) => one.getBoundingClientRect().height));
    list.style.setProperty("--plot-share", `${shareOfList(list.clientHeight, least, head)}px`);
  };
  const resizing = new ResizeObserver(measure);
  for (const one of [list, ...heads]) resizing.observe(one);
  return () => resizing.disconnect();
}
