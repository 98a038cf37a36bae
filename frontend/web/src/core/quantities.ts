/** The numbers of the API as users read and type them: one name and one unit per field. */
import numbers from "numbers:SinePosition ConstantPosition SineStiffness ConstantStiffness ObserverBandwidth ConstantLoad";
import { t } from "./text/t";
import { DEGREES_PER_RADIAN, formatFixed } from "./units";

export interface Quantity {
  label: string;
  unit: string;
  /** Factor from the API's SI unit to the unit on screen. */
  factor?: number;
  /** Bounds of the API, in the unit on screen. */
  min?: number;
  max?: number;
}

const MILLI_LIMIT = 0.1;

/** A number as the API describes it. */
interface Described {
  symbol: string;
  meaning: string;
  unit: string;
  low: number | null;
  high: number | null;
}

/** Label, unit, bounds and factor on screen: angles in degrees, small numbers in thousandths. */
export function quantityOfParameter(parameter: Described): Quantity {
  const { low, high } = parameter;
  const quantity = nameQuantity(parameter);
  const { factor = 1 } = quantity;
  return {
    ...quantity,
    ...(low !== null && { min: low * factor }),
    ...(high !== null && { max: high * factor }),
  };
}

function nameQuantity({ symbol, meaning, unit, high }: Described): Quantity {
  const label = symbol || meaning;
  if (unit === "1" || unit === "") return { label, unit: "" };
  const isSmall = (unit === "s" || unit === "rad") && high !== null && high <= MILLI_LIMIT;
  if (isSmall) return { label, unit: `m${unit}`, factor: 1e3 };
  if (unit === "rad" || unit === "rad·s") {
    return { label, unit: unit.replace("rad", "deg"), factor: DEGREES_PER_RADIAN };
  }
  return { label, unit };
}

/** A number of the API's schema; several requests have the same bounds for a name. */
const number = (name: string, label: string): Quantity => {
  const { unit = "", low = null, high = null } = numbers[name] ?? {};
  return quantityOfParameter({ symbol: label, meaning: "", unit, low, high });
};
const plain = (label: string, unit = ""): Quantity => ({ label, unit });

export const QUANTITIES = {
  amplitude_rad: number("amplitude_rad", t("motion.amplitude")),
  offset_rad: number("offset_rad", t("motion.offset")),
  position_rad: number("position_rad", t("motion.position")),
  frequency_hz: number("frequency_hz", t("motion.frequency")),
  stiffness_nm_per_rad: number("stiffness_nm_per_rad", t("stiffness.level")),
  offset_nm_per_rad: number("offset_nm_per_rad", t("stiffness.mean")),
  amplitude_nm_per_rad: number("amplitude_nm_per_rad", t("stiffness.amplitude")),
  stiffness: number("stiffness_nm_per_rad", t("stiffness.throughout")),
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
  bandwidth_rad_per_s: number("bandwidth_rad_per_s", t("observer.all")),
  torque_nm: number("torque_nm", t("load.torque")),
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
