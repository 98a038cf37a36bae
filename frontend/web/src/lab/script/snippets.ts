/** Values and calls in the syntax of Python and of a shell. */
import type { Call } from "../../core/api/calls";

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

// One call in the words of a shell and of Python.

export const LANGUAGES = ["python", "curl"] as const;
export type Language = (typeof LANGUAGES)[number];
type Request = Pick<Call, "method" | "path" | "body">;

const IMPORT = "import httpx\n\n";

const inShell = (value: string): string => `'${value.replaceAll("'", "'\\''")}'`;

function toCurl({ method, path, body }: Request, api: URL): string {
  const address = inShell(String(new URL(path, api)));
  if (method === "get") return `curl -OJ ${address}`;
  const head = `curl -X ${method.toUpperCase()} ${address}`;
  if (body === undefined) return head;
  return `${head} -H 'Content-Type: application/json' -d ${inShell(JSON.stringify(body))}`;
}

function toHttpx({ method, path, body }: Request, api: URL): string {
  const address = toPython(String(new URL(path, api)));
  const json = body === undefined ? "" : `, json=${toPython(body)}`;
  return `httpx.${method}(${address}${json})`;
}

export function toSnippet(call: Request, language: Language, api: URL): string {
  return language === "python" ? toHttpx(call, api) : toCurl(call, api);
}

/** Many calls, to be pasted as one. */
export function toSnippets(all: readonly Request[], language: Language, api: URL): string {
  const lines = all.map((call) => toSnippet(call, language, api)).join("\n");
  return `${language === "python" ? IMPORT : ""}${lines}\n`;
}
