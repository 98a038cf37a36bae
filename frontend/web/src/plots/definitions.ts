/** What a plot is made of; which plots there are is in alone.ts and compared.ts. */
import type { SessionState } from "../api/types";
import { DEGREES_PER_RADIAN } from "../units";

/** Names of the colours in theme.css: --plot-<name>. */
export type PlotColour = "reference" | "blue" | "orange" | "green" | "vermilion" | "purple";

export interface Trace {
  key: string;
  channel: string;
  /** 1, 2, … */
  lane: number;
  label: string;
  colour: PlotColour;
  dash: readonly number[];
  width: number;
  /** Drawn and hidden together with the trace of this key, and covered by its legend. */
  follows?: string;
}

export interface Bound {
  label: string;
  value: number;
  colour: PlotColour;
}

export interface PlotDefinition {
  key: string;
  title: string;
  unit: string;
  /** From the channel's SI unit to the one on screen. */
  factor: number;
  /** The axis never shows less than this. */
  span: number;
  /** Sets of curves; where there are several, the reader chooses. */
  choices: readonly PlotChoice[];
  /** What the legend cannot say by itself. */
  note?: string;
}

export interface PlotChoice {
  label: string;
  traces: readonly Trace[];
  /** Symmetric limits ±value drawn as faint lines. */
  bounds?: (state: SessionState) => Bound[];
}

export const PLAIN: readonly number[] = [];
export const DASHED: readonly number[] = [6, 5];

/** What of a plot does not depend on how many lanes it shows. */
export const FRAMES = {
  position: { key: "position", unit: "deg", factor: DEGREES_PER_RADIAN, span: 2 },
  error: { key: "error", unit: "deg", factor: DEGREES_PER_RADIAN, span: 0.004 },
  stiffness: { key: "stiffness", unit: "N·m/rad", factor: 1, span: 2 },
  torque: { key: "torque", unit: "N·m", factor: 1, span: 1 },
  disturbance: { key: "disturbance", unit: "N·m", factor: 1, span: 1 },
} as const;
