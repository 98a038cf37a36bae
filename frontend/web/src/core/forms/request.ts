/** The state of a form: its request, and why the server rejected it. */
import { createContext } from "preact";
import { useRef, useState } from "preact/hooks";
import { RefusedError, type Violation } from "../api/errors";
import { firstOf, type Schema, type Values, valueAt } from "../schema";
import { describeError, explain } from "../state/actions";
import type { Live } from "./live";

interface Refusal {
  body: Values;
  message: string;
  violations: readonly Violation[];
  /** The field that shows each violation: the innermost one, because it is rendered first. */
  fields: Map<Violation, string>;
}

export type Offered = readonly { name: string; title: string }[];
/** The choices that the page offers for a field, by the last part of its path. */
export type Choices = Readonly<Record<string, Offered>>;

export interface RequestForm {
  body: Values;
  set: (body: Values) => void;
  choices: Choices;
  refusal: Refusal | null;
  /** Send it: null if it is rejected; the reasons of the last one are shown at their fields. */
  attempt: <T>(send: (body: Values) => Promise<T>) => Promise<T | null>;
}

/** What the fields of a form need; numbers are sent at once by `live`. */
type FormState = Pick<RequestForm, "body" | "choices" | "refusal"> & { live?: Live };

export const FormContext = createContext({} as FormState);

/** A form that begins with the defaults of its schema, and with `first`. */
export function useRequest(
  schema: Schema,
  choices: Choices = {},
  first: Values = {},
  describe: (error: unknown) => string = describeError,
): RequestForm {
  const [body, set] = useState<Values>({ ...(firstOf(schema) as Values), ...first });
  const [refusal, setRefusal] = useState<Refusal | null>(null);
  const attempts = useRef(0);
  const attempt: RequestForm["attempt"] = async (send) => {
    const number = ++attempts.current;
    setRefusal(null);
    try {
      return await send(body);
    } catch (error) {
      if (number !== attempts.current) return null;
      const violations = error instanceof RefusedError ? error.violations : [];
      setRefusal({ body, message: describe(error), violations, fields: new Map() });
      return null;
    }
  };
  return { body, set, choices, refusal, attempt };
}

/** A form for a value of one of several kinds; what was typed for another kind is kept. */
export function useKind(schemaOf: (kind: string) => Schema, firstKind: string) {
  const begin = (kind: string): Values => ({ ...(firstOf(schemaOf(kind)) as Values), kind });
  const form = useRequest({}, {}, begin(firstKind), explain);
  const kind = String(form.body.kind);
  const schema = schemaOf(kind);
  const names = Object.keys(schema.properties ?? {});
  return {
    ...form,
    kind,
    schema,
    /** Those of this kind. */
    values: Object.fromEntries(names.map((name) => [name, form.body[name]])),
    choose: (next: string) => form.set({ ...begin(next), ...form.body, kind: next }),
  };
}

/** Whether the violation is about the value that the form sent, not about a file's text. */
function isAbout({ name, value }: Violation, { body }: Refusal): boolean {
  const sent = valueAt(body, name) ?? null;
  return typeof sent === "object" && sent !== null ? typeof value === "string" : sent === value;
}

/** The violations of a field, until its value has changed. */
export function violationsAt({ refusal, body }: FormState, path: string): Violation[] {
  if (refusal === null || valueAt(body, path) !== valueAt(refusal.body, path)) return [];
  return refusal.violations.filter((violation) => {
    const rest = violation.name.startsWith(path) ? violation.name.slice(path.length) : "-";
    if (!/^$|^[.[]/.test(rest) || !isAbout(violation, refusal)) return false;
    if (!refusal.fields.has(violation)) refusal.fields.set(violation, path);
    return refusal.fields.get(violation) === path;
  });
}

/** The reasons that no field shows. */
export function describeRest({ refusal }: Pick<RequestForm, "refusal">): string {
  if (refusal === null) return "";
  const { fields, message, violations } = refusal;
  if (fields.size === 0) return message;
  const rest = violations.filter((violation) => !fields.has(violation));
  return rest.map((violation) => violation.message).join(" ");
}
