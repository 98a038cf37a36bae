/** Which channels are drawn where. A new plot is a new entry here. */
import type { SessionState } from "../api/types";
import { text } from "../text/en";
import { DEGREES_PER_RADIAN } from "../units";

/** Names of the colours in theme.css: --plot-<name>. */
export type PlotColour = "reference" | "blue" | "orange" | "green" | "vermilion" | "purple";

export interface Trace {
  channel: string;
  label: string;
  colour: PlotColour;
  dashed?: boolean;
  width?: number;
  /** Drawn and hidden together with this channel, and covered by its entry in the legend. */
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
  traces: readonly Trace[];
  /** What the legend cannot say by itself. */
  note?: string;
  /** Symmetric limits ±value drawn as faint lines. */
  bounds?: (state: SessionState) => Bound[];
}

const { plots } = text;

export const PLOTS: readonly PlotDefinition[] = [
  {
    key: "position",
    title: plots.position,
    unit: "deg",
    factor: DEGREES_PER_RADIAN,
    span: 2,
    traces: [
      { channel: "position_rad", label: plots.measured, colour: "blue", width: 3 },
      {
        channel: "position_reference_rad",
        label: plots.reference,
        colour: "reference",
        dashed: true,
      },
    ],
  },
  {
    key: "error",
    title: plots.error,
    unit: "deg",
    factor: DEGREES_PER_RADIAN,
    span: 0.004,
    traces: [
      { channel: "position_error_rad", label: plots.errorTrace, colour: "vermilion", width: 2 },
    ],
  },
  {
    key: "stiffness",
    title: plots.stiffness,
    unit: "N·m/rad",
    factor: 1,
    span: 2,
    traces: [
      { channel: "stiffness_nm_per_rad", label: plots.measured, colour: "green", width: 3 },
      {
        channel: "stiffness_reference_nm_per_rad",
        label: plots.reference,
        colour: "reference",
        dashed: true,
      },
    ],
  },
  {
    key: "torque",
    title: plots.torque,
    unit: "N·m",
    factor: 1,
    span: 1,
    traces: [
      { channel: "torque1_nm", label: plots.torque1, colour: "blue", width: 1.75 },
      { channel: "torque2_nm", label: plots.torque2, colour: "orange", width: 1.75 },
    ],
    bounds: ({ configuration: { limits } }) => [
      { label: plots.limit(plots.torque1), value: limits.torque1_nm, colour: "blue" },
      { label: plots.limit(plots.torque2), value: limits.torque2_nm, colour: "orange" },
    ],
  },
  {
    key: "disturbance",
    title: plots.disturbance,
    note: plots.disturbanceNote,
    unit: "N·m",
    factor: 1,
    span: 1,
    traces: [
      { channel: "estimate_link_nm", label: plots.link, colour: "vermilion", width: 3 },
      { channel: "estimate_motor1_nm", label: plots.motor1, colour: "blue", width: 2 },
      { channel: "estimate_motor2_nm", label: plots.motor2, colour: "purple", width: 1 },
      {
        channel: "disturbance_link_nm",
        label: plots.link,
        colour: "vermilion",
        dashed: true,
        follows: "estimate_link_nm",
      },
      {
        channel: "disturbance_motor1_nm",
        label: plots.motor1,
        colour: "blue",
        dashed: true,
        follows: "estimate_motor1_nm",
      },
      {
        channel: "disturbance_motor2_nm",
        label: plots.motor2,
        colour: "purple",
        dashed: true,
        follows: "estimate_motor2_nm",
      },
    ],
  },
];
