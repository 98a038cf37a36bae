/** What a plot is made of. */
import type { SampleRing } from "../stream/ring";

/** Names of the colours in theme.css: --plot-<name>. */
export type PlotColour = "reference" | "blue" | "orange" | "green" | "vermilion" | "purple";

/** How a curve is drawn. */
export interface LineStyle {
  colour: PlotColour;
  dash: readonly number[];
  width: number;
}

/** Small signs along a curve that tell channels apart where colour and dash tell the lanes. */
export type PlotSign = "none" | "circle" | "square" | "triangle";

export interface Trace extends LineStyle {
  key: string;
  channel: string;
  /** 1, 2, … */
  lane: number;
  label: string;
  /** From the channel's SI unit to the one on screen; negative for the lower of two limits. */
  factor: number;
  sign: PlotSign;
  /** The curve is there from this time on up to before the other, s. */
  from: number;
  to: number;
  /** Drawn and hidden together with the trace of this key, and covered by its legend. */
  follows?: string;
  /** It is another piece of the curve that it follows. */
  continues?: true;
}

/** Lines at ±value. */
export interface Bound {
  label: string;
  value: number;
  colour: PlotColour;
}

/** Several curves that are shown and hidden together: a quantity with its truth or its limit. */
export interface TraceGroup {
  key: string;
  label: string;
  traces: readonly Trace[];
}

/** A plot as it is drawn: of its groups the reader chooses some; the common curves are always there. */
export interface PlotContent {
  groups: readonly TraceGroup[];
  common: readonly Trace[];
}

/** The legend's entry that a piece of a curve stands under. */
export const ownerOf = ({ key, follows, continues }: Trace): string =>
  continues ? (follows ?? key) : key;

// The piece of a lane that a curve is: while the controller that it is named by was in control.

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
