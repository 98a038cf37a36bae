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

/** `head(value)`, the entries of a value that is too long each on a line of its own. */
export function callInPython(head: string, value: unknown, indent = ""): string {
  const line = `${indent}${head}${toPython(value)})`;
  if (line.length <= LINE || value === null || typeof value !== "object") return line;
  const isList = Array.isArray(value);
  const inner = indent + INDENT;
  const rows = Object.entries(value).map(
    ([key, entry]) => `${inner}${isList ? "" : `${quote(key)}: `}${toPython(entry)},`,
  );
  const [open, close] = isList ? ["[", "]"] : ["{", "}"];
  return `${indent}${head}${open}\n${rows.join("\n")}\n${indent}${close})`;
}

/** Text that may stand between the quotes of a docstring. */
export function inDocstring(value: string): string {
  return value.replaceAll("\\", "/").replaceAll('"', "'").replace(/\s+/g, " ").trim();
}
