/** The histogram of a loop's lateness as bars, and how old a reading may be. */
import type { BenchState } from "../core/api/types";

export interface Bar {
  /** Upper edge, s; null for the last bin, which has none. */
  edgeS: number | null;
  count: number;
  /** From 0 to 1 on a logarithmic axis, so that one late tick in a million is still seen. */
  height: number;
}

export function barsOf(edgesS: readonly number[], counts: readonly number[]): Bar[] {
  const top = Math.max(1, ...counts.map(decadesOf));
  return counts.map((count, index) => ({
    edgeS: edgesS[index] ?? null,
    count,
    height: decadesOf(count) / top,
  }));
}

/** How many decades of the axis the bars fill. */
export const decadesIn = (counts: readonly number[]): number =>
  Math.max(1, ...counts.map(decadesOf));

/** One tick stands a little above the ground, ten one decade higher. */
const FOOT = 0.3;
const decadesOf = (count: number): number => (count <= 0 ? 0 : FOOT + Math.log10(count));

export type Freshness = "fresh" | "stale" | "lost" | "silent" | "unheard";
/** What the server says where there was nothing to be heard yet. */
const UNHEARD_S = 1000;

/**
 * By the bounds of the bench file, above which the torque goes to zero, and above which it is a
 * fault. speaks: whether it should be heard at all; a drive that is not armed says nothing.
 */
export function freshnessOf(
  ageS: number,
  {
    stale_zero_s: staleS,
    stale_fault_s: lostS,
  }: Pick<BenchState, "stale_zero_s" | "stale_fault_s">,
  speaks = true,
): Freshness {
  if (!(ageS <= lostS) && !speaks) return "silent";
  if (ageS >= UNHEARD_S) return "unheard";
  if (!(ageS <= lostS)) return "lost";
  return ageS > staleS ? "stale" : "fresh";
}
