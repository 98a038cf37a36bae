/** Schemas of requests for the forms of the page, from docs/openapi.json at each build. */
import type { Plugin } from "vite";

type Schemas = Readonly<Record<string, unknown>>;

const PREFIX = "schema:";
const REFERENCE = "#/components/schemas/";

/** A part of the document in which each reference is replaced by the schema that it names. */
export function resolveReferences(part: unknown, schemas: Schemas): unknown {
  if (Array.isArray(part)) return part.map((item) => resolveReferences(item, schemas));
  if (typeof part !== "object" || part === null) return part;
  const { $ref: reference = "", discriminator, ...own } = part as Record<string, unknown>;
  const named = schemas[String(reference).slice(REFERENCE.length)];
  return Object.fromEntries(
    [named, own].flatMap((half) =>
      Object.entries(half ?? {}).map(([key, value]) => [key, resolveReferences(value, schemas)]),
    ),
  );
}

/** `import schema from "schema:NAME"` in the part of the page that has its form. */
export const requestSchemas = (schemas: Schemas): Plugin => ({
  name: "svsa-request-schemas",
  resolveId: (id) => (id.startsWith(PREFIX) ? `\0${id}` : null),
  load: (id) => {
    if (!id.startsWith(`\0${PREFIX}`)) return null;
    const schema = schemas[id.slice(PREFIX.length + 1)];
    if (schema === undefined) throw new Error(`docs/openapi.json has no ${id.slice(1)}`);
    return `export default JSON.parse(${JSON.stringify(JSON.stringify(resolveReferences(schema, schemas)))})`;
  },
});
