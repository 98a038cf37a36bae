/** What another person has set of a session while one was setting the same. */
import type { Configuration, SessionState } from "../api/types";
import { quantityOf } from "../quantities";
import { text } from "../text/en";
import { effectQuantityOf } from "./kinds";
import { titleOf } from "./laws";
import { show } from "./refusal";
import { session } from "./session";

type Section = keyof Configuration;
type Held = Pick<SessionState, "configuration">;

/** What a path below the session sets, where it is not called after it. */
const SETS: Readonly<Record<string, readonly Section[]>> = {
  law: ["law", "comparisons"],
  lanes: ["comparisons"],
  nominal: ["nominal", "parameters"],
};
const MAX_NAMED = 4;

const listSections = (path: string): readonly Section[] => {
  const [, name = ""] = path.split("/");
  return SETS[name] ?? [name as Section];
};

/**
 * What a section is set to now, for who changes a part of it alone: since the part was drawn, or
 * refused, another person may have set the rest. What was drawn, where the section is of another kind.
 */
export function standing<S extends Section, T extends Configuration[S]>(section: S, drawn: T): T {
  const kindOf = (held: unknown) => (held as { kind?: string }).kind;
  const now = session.peek()?.configuration[section];
  return now !== undefined && kindOf(now) === kindOf(drawn) ? (now as T) : drawn;
}

/** Whether what a path sets is the same in both. */
export function isSame(path: string, before: Held | null, now: Held): boolean {
  const write = (held: Held) =>
    JSON.stringify(listSections(path).map((one) => held.configuration[one]));
  return before !== null && write(before) === write(now);
}

/** Numbers and words of a value by the path of each, such as `noise.motor_std_rad`. */
function flatten(value: unknown, path: string): [path: string, value: unknown][] {
  if (typeof value !== "object" || value === null) return [[path, value]];
  const isList = Array.isArray(value);
  return Object.entries(value).flatMap(([name, inner]) =>
    flatten(inner, isList ? `${path}[${name}]` : `${path}.${name}`),
  );
}

/** A reference's fields are called as they are, the others' after where they stand. */
function nameOf(path: string): string {
  const [section, ...rest] = path.split(".");
  return section === "actuator" || section === "nominal" ? path : (rest.at(-1) ?? path);
}

function describe([path, value]: [path: string, value: unknown]): string | null {
  if (path === "law") return text.meanwhile.law(titleOf(String(value)));
  const quantity = quantityOf(nameOf(path)) ?? effectQuantityOf(path);
  if (quantity === null || typeof value !== "number" || path.includes("coefficients")) return null;
  return text.meanwhile.value(quantity.label, show(value, quantity));
}

/** In words: that it was changed, and what it is now, where the page has a name for it. */
export function describeChange(path: string, before: Held | null, now: Held | null): string {
  if (now === null) return text.meanwhile.changed;
  const known = new Map(
    listSections(path).flatMap((one) => flatten(before?.configuration[one], one)),
  );
  const changed = listSections(path)
    .flatMap((one) => flatten(now.configuration[one], one))
    .filter(([name, value]) => known.get(name) !== value)
    .map(describe)
    .filter((one) => one !== null);
  const list = changed.slice(0, MAX_NAMED).join(", ");
  return `${text.meanwhile.changed} ${list === "" ? text.meanwhile.shown : text.meanwhile.now(list)}`;
}
