/** Bands: the filled areas between two curves with the same gaps. */
import { emptyPoints, lift, makeRoom, type Points, put } from "./decimation";
import type { PlotColour, Trace } from "./definitions";

export const BAND_OPACITY = 0.2;

/** First index, and index after the last, of each piece between two gaps. */
function piecesOf({ y, count }: Points): [number, number][] {
  const pieces: [number, number][] = [];
  for (let index = 0; index < count; index++) {
    if (Number.isNaN(y[index])) continue;
    const last = pieces.at(-1);
    if (last?.[1] === index) last[1]++;
    else pieces.push([index, index + 1]);
  }
  return pieces;
}

/** The outline of the area between two curves with the same gaps: one closed piece per piece. */
export function joinBand(upper: Points, lower: Points): Points {
  const out = emptyPoints();
  makeRoom(out, 2 * (upper.count + lower.count));
  const below = piecesOf(lower);
  for (const [index, [first, end]] of piecesOf(upper).entries()) {
    const [start, stop] = below[index] ?? [0, 0];
    for (let at = first; at < end; at++) put(out, upper.x[at] as number, upper.y[at] as number);
    for (let at = stop - 1; at >= start; at--)
      put(out, lower.x[at] as number, lower.y[at] as number);
    lift(out);
  }
  return out;
}

export interface Banded {
  trace: Trace;
  points: Points;
}

/** The areas among some curves, in the color of the upper one. */
export function bandsOf(curves: readonly Banded[]): { colour: PlotColour; outline: Points }[] {
  return curves.flatMap(({ trace: { fillsTo, colour }, points }) => {
    const other = fillsTo && curves.find(({ trace }) => trace.key === fillsTo);
    return other ? [{ colour, outline: joinBand(points, other.points) }] : [];
  });
}
