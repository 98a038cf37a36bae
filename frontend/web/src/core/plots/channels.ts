/** The server's channels as plots show them: unit, scale, line style, and which belong together. */
import type { SessionState, StreamedName } from "../api/types";
import type { DerivedName } from "../stream/ring";
import { plotsText as text } from "../text/plots";
import { DEGREES_PER_RADIAN } from "../units";
import type { Bound, PlotColour, Trace } from "./definitions";

/** Every channel of the library, and what the page derives of them. */
export type ChannelName = Exclude<StreamedName, "time_s"> | DerivedName;

interface ChannelLook {
  /** On screen. */
  unit: string;
  /** From SI to the unit on screen. */
  factor: number;
  /** The axis never shows less than this, in the unit on screen. */
  span: number;
  colour: PlotColour;
  /** The same in every lane. */
  isReference?: true;
  /** What the channel of this name estimates. */
  truthOf?: ChannelName;
  /** ± this is how far the channel of this name may go. */
  limitOf?: ChannelName;
  /** A fixed limit, ±, in SI. */
  bound?: (state: SessionState) => number;
}

const angle = (colour: PlotColour, span = 2): ChannelLook => ({
  unit: "deg",
  factor: DEGREES_PER_RADIAN,
  span,
  colour,
});
const speed = (colour: PlotColour, span = 2): ChannelLook => ({
  ...angle(colour, span),
  unit: "deg/s",
});
const stiffness = (colour: PlotColour, span = 2): ChannelLook => ({
  unit: "N·m/rad",
  factor: 1,
  span,
  colour,
});
const torque = (colour: PlotColour): ChannelLook => ({ unit: "N·m", factor: 1, span: 1, colour });

export const CHANNELS: Readonly<Record<ChannelName, ChannelLook>> = {
  position_reference_rad: { ...angle("reference"), isReference: true },
  position_rad: angle("blue"),
  position_estimate_rad: angle("orange"),
  position_error_rad: angle("vermilion", 0.004),
  position_residual_rad: angle("purple", 0.004),
  motor1_position_rad: angle("green"),
  motor2_position_rad: angle("purple"),
  deflection_rad: angle("vermilion"),
  deflection_limit_rad: { ...angle("reference"), limitOf: "deflection_rad" },
  velocity_reference_rad_per_s: { ...speed("reference"), isReference: true },
  velocity_rad_per_s: speed("blue"),
  velocity_estimate_rad_per_s: speed("orange"),
  velocity_error_rad_per_s: speed("vermilion", 0.02),
  motor1_velocity_rad_per_s: speed("green"),
  motor2_velocity_rad_per_s: speed("purple"),
  stiffness_reference_nm_per_rad: { ...stiffness("reference"), isReference: true },
  stiffness_nm_per_rad: stiffness("green"),
  stiffness_error_nm_per_rad: stiffness("vermilion", 0.004),
  stiffness_residual_nm_per_rad: stiffness("purple", 0.004),
  torque1_nm: {
    ...torque("blue"),
    bound: ({ configuration: { limits } }) => limits.torque1_nm,
  },
  torque2_nm: {
    ...torque("orange"),
    bound: ({ configuration: { limits } }) => limits.torque2_nm,
  },
  estimate_link_nm: torque("vermilion"),
  estimate_motor1_nm: torque("blue"),
  estimate_motor2_nm: torque("purple"),
  disturbance_link_nm: { ...torque("vermilion"), truthOf: "estimate_link_nm" },
  disturbance_motor1_nm: { ...torque("blue"), truthOf: "estimate_motor1_nm" },
  disturbance_motor2_nm: { ...torque("purple"), truthOf: "estimate_motor2_nm" },
  lever_ratio: { unit: "1", factor: 1, span: 0.1, colour: "green" },
};

const CHANNEL_NAMES = Object.keys(CHANNELS) as ChannelName[];

export const isChannel = (name: unknown): name is ChannelName =>
  typeof name === "string" && Object.hasOwn(CHANNELS, name);

const UNITS = [...new Set(CHANNEL_NAMES.map((name) => CHANNELS[name].unit))];

/** The channels by their unit on screen. */
export const CHANNELS_BY_UNIT = UNITS.map((unit) => ({
  unit,
  channels: CHANNEL_NAMES.filter((name) => CHANNELS[name].unit === unit),
}));

/** The one unit of a plot's channels; "" where it has none. */
export const unitOf = (channels: readonly ChannelName[]): string =>
  channels[0] === undefined ? "" : CHANNELS[channels[0]].unit;

export const spanOf = (channels: readonly ChannelName[]): number =>
  Math.max(...channels.map((name) => CHANNELS[name].span));

// The plots that the lab knows.

const EVERY_PRESET = {
  position: ["position_rad", "position_reference_rad"],
  error: ["position_error_rad"],
  stiffness: ["stiffness_nm_per_rad", "stiffness_reference_nm_per_rad"],
  stiffnessError: ["stiffness_error_nm_per_rad"],
  torque: ["torque1_nm", "torque2_nm"],
  disturbance: [
    "estimate_link_nm",
    "estimate_motor1_nm",
    "estimate_motor2_nm",
    "disturbance_link_nm",
    "disturbance_motor1_nm",
    "disturbance_motor2_nm",
  ],
  deflection: ["deflection_rad", "deflection_limit_rad"],
  /** Across and up; at first ė over e. */
  phase: ["position_error_rad", "velocity_error_rad_per_s"],
} as const satisfies Record<string, readonly ChannelName[]>;

export type PresetName = keyof typeof EVERY_PRESET;
export const PRESETS: Readonly<Record<PresetName, readonly ChannelName[]>> = EVERY_PRESET;
// Fixed limits of what a plot shows, as the session has them now.

/** One for each channel with a limit; in its curve's colour where there is one lane. */
export function boundsOf(traces: readonly Trace[], state: SessionState | null): Bound[] {
  if (state === null) return [];
  const isAlone = traces.every((trace) => trace.lane === 1);
  const limits = new Map<string, Bound>();
  for (const { channel, colour } of traces) {
    const name = channel as ChannelName;
    const value = CHANNELS[name].bound?.(state);
    if (value === undefined || limits.has(channel)) continue;
    limits.set(channel, {
      label: text.plots.limit(text.channelLabels[name]),
      value: value * CHANNELS[name].factor,
      colour: isAlone ? colour : "reference",
    });
  }
  return [...limits.values()];
}
