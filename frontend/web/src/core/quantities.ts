/** The numbers of the API as users read and type them: one name and one unit per field. */
import { text } from "./text/en";
import { DEGREES_PER_RADIAN } from "./units";

export interface Quantity {
  label: string;
  unit: string;
  /** Factor from the API's SI unit to the unit on screen. */
  factor?: number;
  /** Bounds of the API, in the unit on screen. */
  min?: number;
  max?: number;
}

const STIFFNESS = "N·m/rad";
const { motion, stiffness, observer, load, realism, design, transport } = text;
const degrees = (label: string, min: number): Quantity => ({
  label,
  unit: "deg",
  factor: DEGREES_PER_RADIAN,
  min,
  max: 360,
});
const plain = (label: string, unit = "", bounds: Pick<Quantity, "min" | "max"> = {}): Quantity => ({
  label,
  unit,
  ...bounds,
});

export const QUANTITIES = {
  amplitude_rad: degrees(motion.amplitude, 0),
  offset_rad: degrees(motion.offset, -360),
  position_rad: degrees(motion.position, -360),
  frequency_hz: plain(motion.frequency, "Hz", { min: 0, max: 5 }),
  stiffness_nm_per_rad: plain(stiffness.level, STIFFNESS),
  offset_nm_per_rad: plain(stiffness.mean, STIFFNESS),
  amplitude_nm_per_rad: plain(stiffness.amplitude, STIFFNESS, { min: 0, max: 10_000 }),
  stiffness: plain(stiffness.throughout, STIFFNESS),
  position_poles_rad_per_s: plain(design.summary(design.position), design.unit),
  stiffness_poles_rad_per_s: plain(design.summary(design.stiffness), design.unit),
  position_coefficients: plain(design.summary(design.position)),
  stiffness_coefficients: plain(design.summary(design.stiffness)),
  bandwidth_rad_per_s: plain(observer.all, design.unit, { min: 0.1, max: 1000 }),
  torque_nm: plain(load.torque, "N·m", { min: -50, max: 50 }),
  duration_s: plain(load.duration, "s"),
  factor: plain(transport.speed),
  by: plain(text.control.name),
} satisfies Record<string, Quantity>;

/** Properties that a control passes to its field. */
export const quantityProps = (name: keyof typeof QUANTITIES): Quantity => QUANTITIES[name];

const isKey = <T extends object>(key: PropertyKey, table: T): key is keyof T =>
  Object.hasOwn(table, key);

/** The quantity of a path such as `bandwidth_rad_per_s[2]` or `nominal.radius_m`. */
export function quantityOf(path: string): Quantity | null {
  const [, section, name, index] = /^(?:(\w+)\.)?(\w+)(?:\[(\d)\])?$/.exec(path) ?? [];
  if (name === undefined) return null;
  if ((section === "actuator" || section === "nominal") && isKey(name, realism.names)) {
    const [symbol, meaning, unit] = realism.names[name];
    return plain(realism.cell(`${symbol} ${meaning}`, realism[section]), unit);
  }
  if (!isKey(name, QUANTITIES)) return null;
  const quantity = QUANTITIES[name];
  const channel = index !== undefined ? text.channels[Number(index)] : undefined;
  const isByChannel = name === "bandwidth_rad_per_s" || name === "torque_nm";
  return isByChannel && channel
    ? { ...quantity, label: `${quantity.label}, ${channel}` }
    : quantity;
}

const DECIMALS = 1;
const MAX_DECIMALS = 12;
type Shares = readonly [number, number, number];
type Interval = Record<"value" | "low" | "high", number | null>;

/**
 * Shares in percent, with enough digits that different shares read differently, also from 0 and 100
 * %: the lower bound of a million successful runs is not shown as 100 %.
 */
export function formatPercents(shares: Shares): [string, string, string] {
  const exact = (share: number) => Number(share.toFixed(MAX_DECIMALS));
  const ends = [...new Set([0, 1, ...shares.map(exact)])];
  let decimals = DECIMALS;
  const format = (share: number) => (100 * share).toFixed(decimals);
  while (decimals < MAX_DECIMALS && new Set(ends.map(format)).size < ends.length) decimals++;
  return [format(shares[0]), format(shares[1]), format(shares[2])];
}

/** A share with its interval in percent, as "80.0 % (49.0 to 94.3)"; "–" if there is none. */
export const formatShare = (share: Interval): string =>
  share.value === null
    ? "–"
    : text.studies.interval(...formatPercents([share.value, share.low ?? 0, share.high ?? 1]));
