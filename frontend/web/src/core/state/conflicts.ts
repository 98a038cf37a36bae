/** Detects settings that another user changed while this user was changing the same one. */
import type { Configuration, SessionState } from "../api/types";
import { quantityOf } from "../quantities";
import { t } from "../text/t";
import { settings, settingsOf } from "./arm";
import { effectQuantityOf } from "./kinds";
import { titleOf } from "./laws";
import { formatQuantity } from "./refusal";

type Section = keyof Configuration;
type Configured = Pick<SessionState, "configuration">;

/** State that a path below the session sets, if its name differs from the path. */
const SECTIONS_OF_PATH: Readonly<Record<string, readonly Section[]>> = {
  law: ["law", "comparisons"],
  lanes: ["comparisons"],
  nominal: ["nominal", "parameters"],
};
const MAX_LISTED = 4;

const listSections = (path: string): readonly Section[] => {
  const [, name = ""] = path.split("/");
  return SECTIONS_OF_PATH[name] ?? [name as Section];
};

/**
 * Base for a partial change of a section: the values that were drawn or rejected, because another
 * user may have changed the rest. The current ones if the section has another kind now.
 */
export function currentValueOr<S extends Section, T extends Configuration[S]>(
  section: S,
  drawn: T,
): T {
  const kindOf = (state: unknown) => (state as { kind?: string }).kind;
  const now = settings.peek()?.configuration[section];
  return now !== undefined && kindOf(now) === kindOf(drawn) ? (now as T) : drawn;
}

/** Whether two states have the same value at a path. */
export function isSame(path: string, before: Configured | null, now: Configured): boolean {
  const write = (state: Configured) =>
    JSON.stringify(listSections(path).map((item) => settingsOf(state).configuration[item]));
  return before !== null && write(before) === write(now);
}

/** Numbers and words of a value by path, such as `noise.motor_std_rad`. */
function flatten(value: unknown, path: string): [path: string, value: unknown][] {
  if (typeof value !== "object" || value === null) return [[path, value]];
  const isList = Array.isArray(value);
  return Object.entries(value).flatMap(([name, inner]) =>
    flatten(inner, isList ? `${path}[${name}]` : `${path}.${name}`),
  );
}

/** Names of fields: those of a reference as they are, others with the path of their section. */
function nameOf(path: string): string {
  const [section, ...rest] = path.split(".");
  return section === "actuator" || section === "nominal" ? path : (rest.at(-1) ?? path);
}

function describe([path, value]: [path: string, value: unknown]): string | null {
  if (path === "law") return t("meanwhile.law", { title: titleOf(String(value)) });
  const quantity = quantityOf(nameOf(path)) ?? effectQuantityOf(path);
  if (quantity === null || typeof value !== "number" || path.includes("coefficients")) return null;
  return t("meanwhile.value", { label: quantity.label, value: formatQuantity(value, quantity) });
}

/** Message that the value has changed, with the current value if the page has a name for it. */
export function describeChange(
  path: string,
  before: Configured | null,
  now: Configured | null,
): string {
  if (now === null) return t("meanwhile.changed");
  const known = new Map(
    listSections(path).flatMap((item) =>
      flatten(before && settingsOf(before).configuration[item], item),
    ),
  );
  const changed = listSections(path)
    .flatMap((item) => flatten(settingsOf(now).configuration[item], item))
    .filter(([name, value]) => known.get(name) !== value)
    .map(describe)
    .filter((item) => item !== null);
  const list = changed.slice(0, MAX_LISTED).join(", ");
  return `${t("meanwhile.changed")} ${list === "" ? t("meanwhile.shown") : t("meanwhile.now", { list })}`;
}
