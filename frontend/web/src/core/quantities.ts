/** The numbers of the API as users read and type them: one name and one unit per field. */
import { t } from "./text/t";
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
  amplitude_rad: degrees(t("motion.amplitude"), 0),
  offset_rad: degrees(t("motion.offset"), -360),
  position_rad: degrees(t("motion.position"), -360),
  frequency_hz: plain(t("motion.frequency"), "Hz", { min: 0, max: 5 }),
  stiffness_nm_per_rad: plain(t("stiffness.level"), STIFFNESS),
  offset_nm_per_rad: plain(t("stiffness.mean"), STIFFNESS),
  amplitude_nm_per_rad: plain(t("stiffness.amplitude"), STIFFNESS, { min: 0, max: 10_000 }),
  stiffness: plain(t("stiffness.throughout"), STIFFNESS),
  position_poles_rad_per_s: plain(
    t("design.summary", { group: t("design.position") }),
    t("design.unit"),
  ),
  stiffness_poles_rad_per_s: plain(
    t("design.summary", { group: t("design.stiffness") }),
    t("design.unit"),
  ),
  position_coefficients: plain(t("design.summary", { group: t("design.position") })),
  stiffness_coefficients: plain(t("design.summary", { group: t("design.stiffness") })),
  bandwidth_rad_per_s: plain(t("observer.all"), t("design.unit"), { min: 0.1, max: 1000 }),
  torque_nm: plain(t("load.torque"), "N·m", { min: -50, max: 50 }),
  duration_s: plain(t("load.duration"), "s"),
  factor: plain(t("transport.speed")),
  by: plain(t("control.name")),
} satisfies Record<string, Quantity>;

/** Properties that a control passes to its field. */
export const quantityProps = (name: keyof typeof QUANTITIES): Quantity => QUANTITIES[name];

/** Symbols and units of the parameters of an SVSA. */
export const PARAMETERS = {
  link_inertia_kg_m2: ["M", "kg·m²"],
  motor1_inertia_kg_m2: ["B₁", "kg·m²"],
  motor2_inertia_kg_m2: ["B₂", "kg·m²"],
  link_damping_nms_per_rad: ["D", "N·m·s/rad"],
  motor1_damping_nms_per_rad: ["D₁", "N·m·s/rad"],
  motor2_damping_nms_per_rad: ["D₂", "N·m·s/rad"],
  spring_stiffness_n_per_m: ["Kₛ", "N/m"],
} as const;

const isKey = <T extends object>(key: PropertyKey, table: T): key is keyof T =>
  Object.hasOwn(table, key);

/** The quantity of a path such as `bandwidth_rad_per_s[2]` or `nominal.radius_m`. */
export function quantityOf(path: string): Quantity | null {
  const [, section, name, index] = /^(?:(\w+)\.)?(\w+)(?:\[(\d)\])?$/.exec(path) ?? [];
  if (name === undefined) return null;
  if ((section === "actuator" || section === "nominal") && isKey(name, PARAMETERS)) {
    const [symbol, unit] = PARAMETERS[name];
    return plain(
      t("realism.cell", {
        name: `${symbol} ${t(`realism.names.${name}`)}`,
        column: t(`realism.${section}`),
      }),
      unit,
    );
  }
  if (!isKey(name, QUANTITIES)) return null;
  const quantity = QUANTITIES[name];
  const channel =
    index !== undefined ? t("channels", { returnObjects: true })[Number(index)] : undefined;
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
export function formatShare(interval: Interval): string {
  if (interval.value === null) return "–";
  const { value, low, high } = interval;
  const [share, least, most] = formatPercents([value, low ?? 0, high ?? 1]);
  return t("studies.interval", { share, low: least, high: most });
}
