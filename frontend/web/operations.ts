/** The table of the API's operations for the page, made from docs/openapi.json at each build. */

interface Operation {
  parameters?: readonly { name: string; in: string }[];
  "x-permission"?: string;
}
export interface ApiSchema {
  paths: Readonly<Record<string, Readonly<Record<string, Operation>>>>;
}

const PREFIX = "/api/v1";
/** Parameters that the page adds to a call: `core/api/operations.ts`. */
const ADDED = ["joint", "if-match", "idempotency-key"];

/** Most operations only read, and are left out of the table. */
const READ = "observer";

/**
 * The operations, such as "put ~/law", by permission and added parameters, such
 * as "operator joint if-match idempotency-key".
 */
export function tabulate({ paths }: ApiSchema): Record<string, string[]> {
  const table: Record<string, string[]> = {};
  for (const [path, operations] of Object.entries(paths)) {
    for (const [method, { parameters = [], "x-permission": role }] of Object.entries(operations)) {
      const names = parameters.map(({ name }) => name.toLowerCase());
      const takes = [role, ...ADDED.filter((name) => names.includes(name))].join(" ");
      if (takes === READ) continue;
      table[takes] ??= [];
      const template = path.slice(PREFIX.length);
      table[takes].push(`${method} ${template.replace("/sessions/{session}", "~")}`);
    }
  }
  return table;
}
