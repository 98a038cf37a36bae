/** Channels that the page computes from two streamed ones, sample by sample. */
import type { StreamedName } from "../api/types";

interface Derivation {
  of: StreamedName;
  by: StreamedName;
  /** Of the second channel, which is added to the first. */
  factor: number;
}

/** 95 % of a normal distribution are within ±1.96 standard deviations. */
const NORMAL_95 = 1.96;
const [of, by] = ["stiffness_estimate_nm_per_rad", "stiffness_deviation_nm_per_rad"] as const;

const DERIVED_CHANNELS = {
  /** ė = q̇_d − q̇. */
  velocity_error_rad_per_s: {
    of: "velocity_reference_rad_per_s",
    by: "velocity_rad_per_s",
    factor: -1,
  },
  stiffness_upper_nm_per_rad: { of, by, factor: NORMAL_95 },
  stiffness_lower_nm_per_rad: { of, by, factor: -NORMAL_95 },
} as const satisfies Record<string, Derivation>;

export type DerivedName = keyof typeof DERIVED_CHANNELS;
const DERIVED_NAMES = Object.keys(DERIVED_CHANNELS) as DerivedName[];

/** The value of a channel in one sample; NaN if there is none. */
export type ReadChannel = (channel: StreamedName) => number;

const OF_ESTIMATOR: readonly string[] = [
  ...[of, by],
  ...["spring_ratio", "spring_ratio_deviation", "spring_misfit"],
];
/** The server sends 0 while the spring estimator is off: then there is no value. */
export const orMissing = (channel: string, value: number): number =>
  value === 0 && OF_ESTIMATOR.includes(channel) ? Number.NaN : value;

export const isDerived = (channel: string): channel is DerivedName =>
  Object.hasOwn(DERIVED_CHANNELS, channel);

/** The channels to request for a channel: itself, or those it is derived from. */
export function sourcesOf(channel: string): string[] {
  if (!isDerived(channel)) return [channel];
  return [DERIVED_CHANNELS[channel].of, DERIVED_CHANNELS[channel].by];
}

/** The channels that can be derived from these. */
export const derivedFrom = (channels: readonly string[]): DerivedName[] =>
  DERIVED_NAMES.filter((name) => sourcesOf(name).every((source) => channels.includes(source)));

export function derive(name: DerivedName, read: ReadChannel): number {
  const { of: first, by: second, factor } = DERIVED_CHANNELS[name];
  return read(first) + factor * read(second);
}
