/** The server's channels in plots: unit, scale, line style, and related channels. */
import type { SessionState, StreamedName } from "../api/types";
import type { DerivedName } from "../stream/derived";
import { t } from "../text/t";
import { DEGREES_PER_RADIAN } from "../units";
import type { Bound, PlotColour, Trace } from "./definitions";

/** Every channel of the library, and those that the page derives. */
export type ChannelName = Exclude<StreamedName, "time_s"> | DerivedName;

interface ChannelLook {
  /** Unit on screen. */
  unit: string;
  /** Factor from SI to the unit on screen. */
  factor: number;
  /** Minimum range of the axis, in the unit on screen. */
  span: number;
  colour: PlotColour;
  /** Whether all lanes have the same values. */
  isReference?: true;
  /** The channel that this one estimates. */
  truthOf?: ChannelName;
  /** This channel estimates the channel of this name, and has a legend entry next to it. */
  estimateOf?: ChannelName;
  /** Upper and lower edge of its 95 % interval, drawn with it. */
  band?: readonly [ChannelName, ChannelName];
  /** This channel is the limit (±) of the channel of this name. */
  limitOf?: ChannelName;
  /** Fixed limit (±), SI. */
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

/** The largest |u1| or |u2|, N·m; motors that pull against each other add their limits. */
export function largestTorque(
  { actuator, configuration }: SessionState,
  motor: "torque1_nm" | "torque2_nm",
): number {
  const { torque1_nm, torque2_nm } = configuration.limits;
  return actuator.antagonistic ? torque1_nm + torque2_nm : configuration.limits[motor];
}

const torque = (colour: PlotColour): ChannelLook => ({ unit: "N·m", factor: 1, span: 1, colour });
const ratio = (colour: PlotColour): ChannelLook => ({ unit: "1", factor: 1, span: 0.1, colour });

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
  stiffness_estimate_nm_per_rad: {
    ...stiffness("orange"),
    estimateOf: "stiffness_nm_per_rad",
    band: ["stiffness_upper_nm_per_rad", "stiffness_lower_nm_per_rad"],
  },
  stiffness_upper_nm_per_rad: stiffness("orange"),
  stiffness_lower_nm_per_rad: stiffness("orange"),
  stiffness_deviation_nm_per_rad: stiffness("purple", 0.1),
  spring_ratio: ratio("purple"),
  spring_ratio_deviation: ratio("orange"),
  spring_misfit: ratio("vermilion"),
  torque1_nm: {
    ...torque("blue"),
    bound: (state) => largestTorque(state, "torque1_nm"),
  },
  torque2_nm: {
    ...torque("orange"),
    bound: (state) => largestTorque(state, "torque2_nm"),
  },
  estimate_link_nm: torque("vermilion"),
  estimate_motor1_nm: torque("blue"),
  estimate_motor2_nm: torque("purple"),
  disturbance_link_nm: { ...torque("vermilion"), truthOf: "estimate_link_nm" },
  disturbance_motor1_nm: { ...torque("blue"), truthOf: "estimate_motor1_nm" },
  disturbance_motor2_nm: { ...torque("purple"), truthOf: "estimate_motor2_nm" },
  lever_ratio: ratio("green"),
  payload_estimate_kg: { unit: "kg", factor: 1, span: 0.1, colour: "orange" },
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

/** The common unit of a plot's channels; "" if it has none. */
export const unitOf = (channels: readonly ChannelName[]): string =>
  channels[0] === undefined ? "" : CHANNELS[channels[0]].unit;

export const spanOf = (channels: readonly ChannelName[]): number =>
  Math.max(...channels.map((name) => CHANNELS[name].span));

// The predefined plots.

const EVERY_PRESET = {
  position: ["position_rad", "position_reference_rad"],
  error: ["position_error_rad"],
  stiffness: [
    "stiffness_nm_per_rad",
    "stiffness_estimate_nm_per_rad",
    "stiffness_reference_nm_per_rad",
  ],
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
  /** Horizontal and vertical channel; initially ė over e. */
  phase: ["position_error_rad", "velocity_error_rad_per_s"],
} as const satisfies Record<string, readonly ChannelName[]>;

export type PresetName = keyof typeof EVERY_PRESET;
export const PRESETS: Readonly<Record<PresetName, readonly ChannelName[]>> = EVERY_PRESET;
// Fixed limits of a plot's channels in the current session.

/**
 * One limit for each channel that has one, and one for channels with the same limit; in the color
 * of its curve if there is one lane.
 */
export function boundsOf(traces: readonly Trace[], state: SessionState | null): Bound[] {
  if (state === null) return [];
  const isAlone = new Set(traces.map(({ lane }) => lane)).size <= 1;
  const limits = new Map<number, { names: Set<string>; colour: Bound["colour"] }>();
  for (const { channel, colour } of traces) {
    const name = channel as ChannelName;
    const bound = CHANNELS[name].bound?.(state);
    if (bound === undefined) continue;
    const value = bound * CHANNELS[name].factor;
    const label = t(`channelLabels.${name}`);
    const same = limits.get(value);
    if (same === undefined) {
      limits.set(value, { names: new Set([label]), colour: isAlone ? colour : "reference" });
    } else if (!same.names.has(label)) {
      same.names.add(label);
      same.colour = "reference";
    }
  }
  return [...limits].map(([value, { names, colour }]) => ({
    label: t("plots.limit", { label: [...names].join(", ") }),
    value,
    colour,
  }));
}
