/** Channels that the page derives from two that are streamed: `of` less `less`, sample by sample. */
import type { StreamedName } from "../api/types";

export const DERIVED = {
  /** ė = q̇_d − q̇. */
  velocity_error_rad_per_s: { of: "velocity_reference_rad_per_s", less: "velocity_rad_per_s" },
} as const satisfies Record<string, { of: StreamedName; less: StreamedName }>;

export type DerivedName = keyof typeof DERIVED;
const NAMES = Object.keys(DERIVED) as DerivedName[];

/** What can be derived from these channels. */
export const derivedFrom = (channels: readonly string[]): DerivedName[] =>
  NAMES.filter(
    (name) => channels.includes(DERIVED[name].of) && channels.includes(DERIVED[name].less),
  );

/** The channels to be streamed for a channel: itself, or those it is derived from. */
export function sourcesOf(channel: string): string[] {
  if (!Object.hasOwn(DERIVED, channel)) return [channel];
  const { of, less } = DERIVED[channel as DerivedName];
  return [of, less];
}
