/** What a plot is made of. */

/** Names of the colours in theme.css: --plot-<name>. */
export type PlotColour = "reference" | "blue" | "orange" | "green" | "vermilion" | "purple";

/** How a curve is drawn. */
export interface Ink {
  colour: PlotColour;
  dash: readonly number[];
  width: number;
}

/** Small signs along a curve that tell channels apart where colour and dash tell the lanes. */
export type PlotSign = "none" | "circle" | "square" | "triangle";

export interface Trace extends Ink {
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
