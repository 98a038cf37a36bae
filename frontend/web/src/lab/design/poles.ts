/** Poles in the plane: single real ones, and complex ones with their conjugate. */

import { FIELDS } from "../../core/quantities";
import { quantityOfSchema } from "../../core/schema";

export interface Pole {
  re: number;
  /** Zero on the real axis; a pole at re + j·im has its conjugate at re − j·im. */
  im: number;
}

export type Poles = readonly Pole[];

/** A pole closer to the real axis than this becomes real, rad/s. */
const SNAP = 4;
export const MAX_RE = 40;
export const MIN_RE = -300;
export const MAX_IM = 120;
/** Of a bandwidth that is typed, rad/s. */
const { min = 0, max = 0 } = quantityOfSchema(FIELDS.bandwidth_rad_per_s);
export const BANDWIDTH_BOUNDS = { min, max };

const clamp = (value: number, least: number, most: number) =>
  Math.min(most, Math.max(least, value));
const rounded = (value: number) => Math.round(value * 10) / 10;

/** Roots from the server; rounding errors around a multiple real root are removed. */
export function polesOf(roots: readonly Pole[]): Pole[] {
  const clean = roots.map(({ re, im }) => ({ re: rounded(re), im: rounded(im) }));
  const mean = clean.reduce((sum, { re }) => sum + re, 0) / clean.length;
  const spread = Math.max(...clean.map(({ re, im }) => Math.hypot(re - mean, im)));
  if (spread > 0.02 * Math.abs(mean)) return pairUp(clean);
  return clean.map(() => ({ re: rounded(mean), im: 0 }));
}

/** Each complex pole followed by its conjugate, so that both have exactly the same values. */
function pairUp(poles: Poles): Pole[] {
  const above = poles.filter(({ im }) => im > 0);
  const onAxis = poles.filter(({ im }) => im === 0);
  return [
    ...onAxis,
    ...above.flatMap(({ re, im }) => [
      { re, im },
      { re, im: -im },
    ]),
  ];
}

/**
 * The pole that moves along when this one leaves the axis: its conjugate, or the nearest real one.
 */
export function partnerOf(poles: Poles, index: number): number {
  const moved = poles[index] as Pole;
  let best = -1;
  let distance = Number.POSITIVE_INFINITY;
  poles.forEach((pole, other) => {
    if (other === index) return;
    const isPossible =
      moved.im === 0 ? pole.im === 0 : pole.im === -moved.im && pole.re === moved.re;
    if (!isPossible || Math.abs(pole.re - moved.re) >= distance) return;
    distance = Math.abs(pole.re - moved.re);
    best = other;
  });
  return best;
}

/**
 * The poles with one of them moved from its position at the start of the drag. Off the axis its
 * partner becomes the conjugate; on the axis a partner that came from there returns to its
 * position.
 */
export function movePole(start: Poles, index: number, to: Pole): Pole[] {
  const partner = partnerOf(start, index);
  const isOnAxis = Math.abs(to.im) < SNAP || partner < 0;
  const re = rounded(clamp(to.re, MIN_RE, MAX_RE));
  const im = isOnAxis ? 0 : rounded(clamp(to.im, -MAX_IM, MAX_IM));
  const wasPair = (start[index] as Pole).im !== 0;
  return start.map((pole, other) => {
    if (other === index) return { re, im };
    if (other !== partner || (isOnAxis && !wasPair)) return pole;
    return { re, im: im === 0 ? 0 : -im };
  });
}

/** One step of an arrow key: off the axis at once, and back onto it if the step ends near it. */
export function stepPole(poles: Poles, index: number, dRe: number, dIm: number): Pole[] {
  const { re, im } = poles[index] as Pole;
  const isLeaving = im === 0 && dIm !== 0;
  const next = isLeaving ? Math.sign(dIm) * Math.max(SNAP, Math.abs(dIm)) : im + dIm;
  return movePole(poles, index, { re: re + dRe, im: next });
}

export const allAt = (count: number, bandwidth: number): Pole[] =>
  Array.from({ length: count }, () => ({ re: -bandwidth, im: 0 }));

/** p if all poles are at −p; otherwise the geometric mean of their magnitudes, as c₀ = pⁿ. */
export function bandwidthOf(poles: Poles): number {
  const product = poles.reduce((size, { re, im }) => size * Math.hypot(re, im), 1);
  return product ** (1 / poles.length);
}

/** c₀ … c_{n−1} of (s + p)ⁿ. */
export function coefficientsOf(count: number, bandwidth: number): number[] {
  let polynomial = [1];
  for (let power = 0; power < count; power++) {
    polynomial = [...polynomial, 0].map((_, k) => {
      return bandwidth * (polynomial[k] ?? 0) + (polynomial[k - 1] ?? 0);
    });
  }
  return polynomial.slice(0, count);
}

export const areTogether = (poles: Poles): boolean =>
  poles.every(({ re, im }) => im === 0 && re === poles[0]?.re);

/** Format of a pole in the API: a real part, or [re, im]. */
export const toRequest = ({ re, im }: Pole): number | [number, number] =>
  im === 0 ? re : [re, im];

interface Place {
  pole: Pole;
  count: number;
}

/** Number of coinciding poles at each position. */
export function countPlaces(poles: Poles): Place[] {
  const places: Place[] = [];
  for (const pole of poles) {
    const place = places.find((known) => known.pole.re === pole.re && known.pole.im === pole.im);
    if (place) place.count += 1;
    else places.push({ pole, count: 1 });
  }
  return places;
}
