/** JSON values as Python writes them. */

const INDENT = "    ";
const LINE = 92;

/** A string as Python reads it: JSON's escapes are Python's too. */
const quote = (value: string): string => JSON.stringify(value);

export function toPython(value: unknown): string {
  if (value === null || value === undefined) return "None";
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value === "number") return String(value);
  if (typeof value === "string") return quote(value);
  if (Array.isArray(value)) return `[${value.map(toPython).join(", ")}]`;
  const entries = Object.entries(value as object).filter(([, inner]) => inner !== undefined);
  return `{${entries.map(([key, inner]) => `${quote(key)}: ${toPython(inner)}`).join(", ")}}`;
}

export type Fields = Record<string, unknown>;

/** `head` closed with these keyword arguments, one a line where a single line is too short. */
export function toRows(head: string, fields: Fields, indent: string): string {
  const parts = Object.entries(fields).map(([name, value]) => `${name}=${toPython(value)}`);
  const line = `${head}${parts.join(", ")})`;
  if (indent.length + line.length <= LINE) return line;
  const inner = indent + INDENT;
  return `${head.trimEnd()}\n${parts.map((part) => `${inner}${part},`).join("\n")}\n${indent})`;
}

/** A value of the library by its name and fields, within a line of this indent. */
export const buildValue = (name: string, fields: Fields, indent: string): string =>
  toRows(`${name}(`, fields, indent);

/** Text that may stand between the quotes of a docstring. */
export function inDocstring(value: string): string {
  return value.replaceAll("\\", "/").replaceAll('"', "'").replace(/\s+/g, " ").trim();
}
