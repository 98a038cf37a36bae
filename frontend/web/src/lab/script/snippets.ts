/** Values and calls in the syntax of Python and of a shell. */
import type { Call } from "../../core/api/calls";

const INDENT = "    ";
const LINE = 92;

/** A Python string literal: JSON's escapes are valid in Python. */
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

/** `head` with these keyword arguments, one per line if a single line is too long. */
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

/** Text without characters that would end a docstring. */
export function inDocstring(value: string): string {
  return value.replaceAll("\\", "/").replaceAll('"', "'").replace(/\s+/g, " ").trim();
}

// One call as a shell command and as Python.

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

/** Several calls as one text to paste. */
export function toSnippets(all: readonly Request[], language: Language, api: URL): string {
  const lines = all.map((call) => toSnippet(call, language, api)).join("\n");
  return `${language === "python" ? IMPORT : ""}${lines}\n`;
}
