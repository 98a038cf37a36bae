/** How high the chart of the error is. */
import { text } from "../../core/text/en";
import type { Axis, Curve } from "./curves";

const HEIGHTS = [2, 3, 4, 5, 6, 8, 10, 15, 20, 40];

/** The error, high enough for both curves, with the side on which they are. */
export function errorAxis(curves: readonly Curve["points"][]): Axis {
  const values = curves.flatMap((points) => points.map(([, value]) => value));
  const least = Math.min(0, ...values);
  const most = Math.max(0, ...values);
  const height = (size: number) =>
    size < 0.05 * Math.max(-least, most)
      ? 0
      : (HEIGHTS.find((one) => one >= 1.05 * size) ?? (HEIGHTS.at(-1) as number));
  const from = -height(-least);
  const to = height(most) || (from === 0 ? 2 : 0.15 * -from);
  const reach = Math.max(-from, to);
  const ticks = [-reach, -reach / 2, 0, reach / 2, reach].filter(
    (tick) => tick >= from && tick <= to,
  );
  return { from, to, ticks, label: text.stability.error };
}
