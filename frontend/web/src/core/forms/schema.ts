/** The fields of a request, as the API's schema describes them. */
import { type Quantity, quantityOfParameter } from "../quantities";

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
}

export type Values = Readonly<Record<string, unknown>>;

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

/** Label, unit and bounds on screen, of a number or of the numbers of a list. */
export function quantityOfSchema({ title = "", unit = "", ...number }: Schema): Quantity {
  const { minimum, exclusiveMinimum, maximum } = number;
  const low = minimum ?? exclusiveMinimum ?? null;
  return quantityOfParameter({ symbol: "", meaning: title, unit, low, high: maximum ?? null });
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

/** The value at a path such as `terms[0].start_s`. */
export const valueAt = (body: unknown, path: string): unknown =>
  path
    .split(/[.[\]]+/)
    .filter(Boolean)
    .reduce<unknown>((value, key) => (value as Record<string, unknown> | undefined)?.[key], body);
