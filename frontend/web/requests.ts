/** Schemas of requests for the forms of the page, from docs/openapi.json at each build. */
import type { Plugin } from "vite";

interface Request {
  properties?: Readonly<Record<string, Field>>;
}
interface Field {
  type?: string;
  unit?: string;
  minimum?: number;
  exclusiveMinimum?: number;
  maximum?: number;
  prefixItems?: readonly Field[];
}
type Schemas = Readonly<Record<string, unknown>>;

const PREFIX = /^\0?(schema|numbers):/;
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

/** Unit and bounds of the numbers of some requests, by name; of a list those of its first. */
function tabulateNumbers(names: string, schemas: Schemas): object {
  const fields = names
    .split(" ")
    .flatMap((name) => Object.entries((schemas[name] as Request).properties ?? {}));
  const numbers = fields.map(([name, field]) => {
    const { type, minimum, exclusiveMinimum, maximum } = field.prefixItems?.[0] ?? field;
    return [name, { type, unit: field.unit, minimum, exclusiveMinimum, maximum }] as const;
  });
  return Object.fromEntries(numbers.filter(([, { type }]) => type === "number"));
}

/**
 * `import schema from "schema:NAME"` in the part of the page that has its form, and `import numbers
 * from "numbers:NAME NAME"` for fields with texts of their own.
 */
export const requestSchemas = (schemas: Schemas): Plugin => ({
  name: "svsa-request-schemas",
  resolveId: (id) => (PREFIX.test(id) ? `\0${id.replace("\0", "")}` : null),
  load: (id) => {
    if (!PREFIX.test(id)) return null;
    const names = id.replace(PREFIX, "");
    const unknown = names.split(" ").filter((name) => !(name in schemas));
    if (unknown.length > 0)
      throw new Error(`docs/openapi.json has no schema ${unknown.join(", ")}`);
    const content = id.includes("numbers:")
      ? tabulateNumbers(names, schemas)
      : resolveReferences(schemas[names], schemas);
    return `export default JSON.parse(${JSON.stringify(JSON.stringify(content))})`;
  },
});
