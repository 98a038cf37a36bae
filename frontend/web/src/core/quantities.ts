/** The numbers of the API as users read and type them: one name and one unit per field. */
import numbers from "numbers:SinePosition ConstantPosition SineStiffness ConstantStiffness ObserverBandwidth ConstantLoad TipMass";
import { type Quantity, quantityOfSchema, type Schema } from "./schema";
import { t } from "./text/t";
import { formatFixed } from "./units";

/** A number of the API's schema; several requests have the same bounds for a name. */
const number = (name: string, title: string): Schema => ({ ...numbers[name], title });
const plain = (title: string, unit = ""): Schema => ({ title, unit });
const poles = (group: "position" | "stiffness") =>
  t("design.summary", { group: t(`design.${group}`) });

/** Fields by their names in the API, with the labels of the page. */
export const FIELDS = {
  amplitude_rad: number("amplitude_rad", t("motion.amplitude")),
  offset_rad: number("offset_rad", t("motion.offset")),
  position_rad: number("position_rad", t("motion.position")),
  frequency_hz: number("frequency_hz", t("motion.frequency")),
  stiffness_nm_per_rad: number("stiffness_nm_per_rad", t("stiffness.level")),
  offset_nm_per_rad: number("offset_nm_per_rad", t("stiffness.mean")),
  amplitude_nm_per_rad: number("amplitude_nm_per_rad", t("stiffness.amplitude")),
  stiffness: number("stiffness_nm_per_rad", t("stiffness.throughout")),
  position_poles_rad_per_s: plain(poles("position"), t("design.unit")),
  stiffness_poles_rad_per_s: plain(poles("stiffness"), t("design.unit")),
  position_coefficients: plain(poles("position")),
  stiffness_coefficients: plain(poles("stiffness")),
  bandwidth_rad_per_s: number("bandwidth_rad_per_s", t("observer.all")),
  torque_nm: number("torque_nm", t("load.torque")),
  mass_kg: number("mass_kg", t("arm.mass")),
  duration_s: plain(t("load.duration"), "s"),
  factor: plain(t("transport.speed")),
  by: plain(t("control.name")),
} satisfies Record<string, Schema>;

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
    const label = t("realism.cell", {
      name: `${symbol} ${t(`realism.names.${name}`)}`,
      column: t(`realism.${section}`),
    });
    return { label, unit };
  }
  if (!isKey(name, FIELDS)) return null;
  const quantity = quantityOfSchema(FIELDS[name]);
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
  const format = (share: number) => formatFixed(100 * share, decimals);
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
