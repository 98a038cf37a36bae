/** The histogram of a loop's lateness as bars, and how old a reading may be. */

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
const STALE_S = 0.005;
const LOST_S = 0.02;
/** What the server says where there was nothing to be heard yet. */
const UNHEARD_S = 1000;

/**
 * The bounds of the safety rules: above 5 ms the torque goes to zero, above 20 ms it is a fault.
 * speaks: whether it should be heard at all; a drive that is not armed says nothing.
 */
export function freshnessOf(ageS: number, speaks = true): Freshness {
  if (!(ageS <= LOST_S) && !speaks) return "silent";
  if (ageS >= UNHEARD_S) return "unheard";
  if (!(ageS <= LOST_S)) return "lost";
  return ageS > STALE_S ? "stale" : "fresh";
}
