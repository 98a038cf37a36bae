/** One call in the words of a shell and of Python. */
import type { Call } from "../../core/api/calls";
import { toPython } from "./python";

export const LANGUAGES = ["python", "curl"] as const;
export type Language = (typeof LANGUAGES)[number];
type Request = Pick<Call, "method" | "path" | "body">;

export const IMPORT = "import httpx\n\n";

const inShell = (value: string): string => `'${value.replaceAll("'", "'\\''")}'`;

export function toCurl({ method, path, body }: Request, api: URL): string {
  const address = inShell(String(new URL(path, api)));
  if (method === "get") return `curl -OJ ${address}`;
  const head = `curl -X ${method.toUpperCase()} ${address}`;
  if (body === undefined) return head;
  return `${head} -H 'Content-Type: application/json' -d ${inShell(JSON.stringify(body))}`;
}

export function toHttpx({ method, path, body }: Request, api: URL): string {
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
