/** Types that define a plot. */
import type { SampleRing } from "../stream/ring";

/** Names of the colors in theme.css: --plot-<name>. */
export type PlotColour = "reference" | "blue" | "orange" | "green" | "vermilion" | "purple";

/** Style of a curve. */
export interface LineStyle {
  colour: PlotColour;
  dash: readonly number[];
  width: number;
}

/**
 * Small markers along a curve that distinguish channels if color and dash distinguish the lanes.
 */
export type PlotSign = "none" | "circle" | "square" | "triangle";

export interface Trace extends LineStyle {
  key: string;
  channel: string;
  /** Number of the lane, from 1. */
  lane: number;
  label: string;
  /**
   * Factor from the channel's SI unit to the unit on screen; negative for the lower of two limits.
   */
  factor: number;
  sign: PlotSign;
  /** The curve exists from the first time up to before the second, s. */
  from: number;
  to: number;
  /** Shown and hidden together with the trace of this key, and part of its legend entry. */
  follows?: string;
  /** Whether it is another piece of the curve that it belongs to. */
  continues?: true;
  /** The area up to the curve of this key is filled. */
  fillsTo?: string;
}

/** Lines at ±value. */
export interface Bound {
  label: string;
  value: number;
  colour: PlotColour;
}

/** Curves that are shown and hidden together: a quantity with its true value or its limit. */
export interface TraceGroup {
  key: string;
  label: string;
  traces: readonly Trace[];
}

/** A plot as drawn: the user selects some of its groups; the common curves are always shown. */
export interface PlotContent {
  groups: readonly TraceGroup[];
  common: readonly Trace[];
}

/** Legend entry of a piece of a curve. */
export const ownerOf = ({ key, follows, continues }: Trace): string =>
  continues ? (follows ?? key) : key;

// A curve of a lane exists while the controller after which it is named was in control.

type Piece = Pick<Trace, "channel" | "lane" | "factor" | "from" | "to">;

export const isWithin = ({ from, to }: Pick<Trace, "from" | "to">, timeS: number): boolean =>
  timeS >= from && timeS < to;

/** Those samples from `first` up to before `end` that belong to the piece. */
export function samplesOf(
  ring: SampleRing,
  { from, to }: Pick<Trace, "from" | "to">,
  first: number,
  end: number,
): { first: number; end: number } {
  return { first: Math.max(first, ring.lowerBound(from)), end: Math.min(end, ring.lowerBound(to)) };
}

/** Value of a sample in the unit on screen; NaN outside the piece. */
export const readPiece = (ring: SampleRing, piece: Piece, index: number): number =>
  isWithin(piece, ring.timeAt(index))
    ? ring.valueAt(piece.channel, index, piece.lane) * piece.factor
    : Number.NaN;
