/** Fields as the API describes them: by a request's schema, or by parameters of a kind. */
import type { SliderRange } from "./scale";
import { DEGREES_PER_RADIAN } from "./units";

/** A part of a request's JSON Schema, with the annotations of the server's `quantity`. */
export interface Schema {
  type?: string;
  title?: string;
  description?: string;
  unit?: string;
  /** Labels of the numbers of a list. */
  parts?: readonly string[];
  /** Labels of the values of `enum`. */
  choices?: Readonly<Record<string, string>>;
  /** What applies if the optional field is empty. */
  empty?: string;
  default?: unknown;
  examples?: readonly unknown[];
  const?: string;
  enum?: readonly string[];
  minimum?: number;
  exclusiveMinimum?: number;
  maximum?: number;
  maxLength?: number;
  minItems?: number;
  maxItems?: number;
  properties?: Readonly<Record<string, Schema>>;
  required?: readonly string[];
  additionalProperties?: boolean | Schema;
  items?: Schema;
  prefixItems?: readonly Schema[];
  oneOf?: readonly Schema[];
  anyOf?: readonly Schema[];
  // Of a number that the page sends at once:
  /** Label in place of the title, which then is for screen readers. */
  symbol?: string;
  /** A line above the field. */
  about?: string;
  slider?: SliderRange;
  /** Without a unit of the screen, such as degrees. */
  isSi?: boolean;
}

export type Values = Readonly<Record<string, unknown>>;

/** A number that the server describes at run time: add-ons have kinds of their own. */
type Parameter = Readonly<
  Record<"name" | "symbol" | "meaning" | "unit", string> & Record<"low" | "high", number | null>
>;

export const schemaOfParameter = (row: Parameter): Schema => ({
  type: "number",
  title: row.symbol || row.meaning,
  ...(row.symbol && { description: row.meaning }),
  unit: row.unit,
  ...(row.low !== null && { minimum: row.low }),
  ...(row.high !== null && { maximum: row.high }),
});

export const schemaOfParameters = (rows: readonly Parameter[]): Schema => ({
  properties: Object.fromEntries(rows.map((row) => [row.name, schemaOfParameter(row)])),
});

interface Kind {
  kind: string;
  form: readonly { parameter: Parameter; first: number }[] | null;
}

/** The form of a kind of load or reference; without fields if there is no such kind. */
export function schemaOfKind(kind: string, rows: readonly Kind[]): Schema {
  const form = rows.find((row) => row.kind === kind)?.form ?? [];
  const fields = form.map(({ parameter, first }) => [
    parameter.name,
    { ...schemaOfParameter(parameter), default: first },
  ]);
  return { properties: { kind: { const: kind }, ...Object.fromEntries(fields) } };
}

/** A field that may be null has the schema of its value, and is optional. */
export function readField(schema: Schema): Schema & { isOptional: boolean } {
  const value = schema.anyOf?.find(({ type }) => type !== "null");
  return { ...value, ...schema, isOptional: value !== undefined };
}

export const isNumber = ({ type }: Schema): boolean => type === "number" || type === "integer";

/** The value of a field at first; undefined if it is empty. */
export function firstOf(schema: Schema): unknown {
  const { properties, oneOf, required = [] } = schema;
  const first = schema.const ?? schema.default ?? schema.examples?.[0];
  if (first !== undefined) return first;
  if (oneOf?.[0]) return firstOf(oneOf[0]);
  if (!properties) return undefined;
  return Object.fromEntries(
    Object.entries(properties)
      .map(([name, property]) => [name, firstOf(property)] as const)
      .filter(([name, value]) => value !== undefined || required.includes(name)),
  );
}

export interface Quantity {
  label: string;
  unit: string;
  /** Factor from the API's SI unit to the unit on screen. */
  factor?: number;
  /** Bounds of the API, in the unit on screen. */
  min?: number;
  max?: number;
}

const MILLI_LIMIT = 0.1;

function unitOf({ unit = "", maximum, isSi }: Schema): { unit: string; factor?: number } {
  if (unit === "1" || isSi) return { unit: unit === "1" ? "" : unit };
  const isSmall =
    (unit === "s" || unit === "rad") && maximum !== undefined && maximum <= MILLI_LIMIT;
  if (isSmall) return { unit: `m${unit}`, factor: 1e3 };
  if (unit === "rad" || unit === "rad·s") {
    return { unit: unit.replace("rad", "deg"), factor: DEGREES_PER_RADIAN };
  }
  return { unit };
}

/** Label, unit, bounds and factor on screen: angles in degrees, small numbers in thousandths. */
export function quantityOfSchema(schema: Schema): Quantity {
  const { title = "", exclusiveMinimum, minimum = exclusiveMinimum, maximum } = schema;
  const quantity = { label: title, ...unitOf(schema) };
  const { factor = 1 } = quantity;
  return {
    ...quantity,
    ...(minimum !== undefined && { min: minimum * factor }),
    ...(maximum !== undefined && { max: maximum * factor }),
  };
}

const kindOf = ({ properties }: Schema) => properties?.kind;

/** The kinds of a union, by name: the schema of each, and its title. */
export const kindsOf = ({ oneOf = [] }: Schema): Map<string, { title: string; schema: Schema }> =>
  new Map(
    oneOf.map((schema) => {
      const { const: name = "", title = name } = kindOf(schema) ?? {};
      return [name, { title, schema }];
    }),
  );

/** A value as another kind: the fields that both have are kept. */
export function changeKind(value: Values, next: Schema): Values {
  const shared = Object.keys(value).filter((name) => name !== "kind" && next.properties?.[name]);
  return {
    ...(firstOf(next) as Values),
    ...Object.fromEntries(shared.map((name) => [name, value[name]])),
  };
}

const keysOf = (path: string) => path.split(/[.[\]]+/).filter(Boolean);

/** The value at a path such as `terms[0].start_s`. */
export const valueAt = (body: unknown, path: string): unknown =>
  keysOf(path).reduce<unknown>(
    (value, key) => (value as Record<string, unknown> | undefined)?.[key],
    body,
  );

/** The body with another value at a path. */
export function changeAt<T>(body: T, path: string, value: unknown): T {
  const [key, ...rest] = keysOf(path);
  if (key === undefined) return value as T;
  const inner = changeAt(valueAt(body, key), rest.join("."), value);
  return Array.isArray(body)
    ? (body.map((item, at) => (String(at) === key ? inner : item)) as T)
    : { ...body, [key]: inner };
}
