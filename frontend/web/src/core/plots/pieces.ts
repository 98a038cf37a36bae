/** The piece of a lane that a curve is: while the controller that it is named by was in control. */
import type { SampleRing } from "../stream/ring";
import type { Trace } from "./definitions";

type Piece = Pick<Trace, "channel" | "lane" | "factor" | "from" | "to">;

export const isWithin = ({ from, to }: Pick<Trace, "from" | "to">, timeS: number): boolean =>
  timeS >= from && timeS < to;

/** Of the samples from `first` up to before `end` those of the piece. */
export function samplesOf(
  ring: SampleRing,
  { from, to }: Pick<Trace, "from" | "to">,
  first: number,
  end: number,
): { first: number; end: number } {
  return { first: Math.max(first, ring.firstAt(from)), end: Math.min(end, ring.firstAt(to)) };
}

/** Value of a sample on screen; NaN outside the piece. */
export const readPiece = (ring: SampleRing, piece: Piece, index: number): number =>
  isWithin(piece, ring.timeAt(index))
    ? ring.valueAt(piece.channel, index, piece.lane) * piece.factor
    : Number.NaN;
