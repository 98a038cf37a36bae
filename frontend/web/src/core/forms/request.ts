/** The state of a form: its request, and why the server rejected it. */
import { createContext } from "preact";
import { useState } from "preact/hooks";
import { RefusedError, type Violation } from "../api/errors";
import { explain } from "../state/actions";
import { firstOf, type Schema, type Values, valueAt } from "./schema";

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
  /** Send it: null if it is rejected; the reasons are then shown at their fields. */
  attempt: <T>(send: (body: Values) => Promise<T>) => Promise<T | null>;
}

export const FormContext = createContext({} as RequestForm);

/** A form that begins with the defaults of its schema, and with `first`. */
export function useRequest(schema: Schema, choices: Choices = {}, first: Values = {}): RequestForm {
  const [body, set] = useState<Values>({ ...(firstOf(schema) as Values), ...first });
  const [refusal, setRefusal] = useState<Refusal | null>(null);
  const attempt: RequestForm["attempt"] = async (send) => {
    setRefusal(null);
    try {
      return await send(body);
    } catch (error) {
      const isRefused = error instanceof RefusedError;
      const message = isRefused ? error.message : explain(error);
      const violations = isRefused ? error.violations : [];
      setRefusal({ body, message, violations, fields: new Map() });
      return null;
    }
  };
  return { body, set, choices, refusal, attempt };
}

/** Whether the violation is about the value that the form sent, not about a file's text. */
function isAbout({ name, value }: Violation, { body }: Refusal): boolean {
  const sent = valueAt(body, name) ?? null;
  return typeof sent === "object" && sent !== null ? typeof value === "string" : sent === value;
}

/** The violations of a field, until its value has changed. */
export function violationsAt({ refusal, body }: RequestForm, path: string): Violation[] {
  if (refusal === null || valueAt(body, path) !== valueAt(refusal.body, path)) return [];
  return refusal.violations.filter((violation) => {
    const rest = violation.name.startsWith(path) ? violation.name.slice(path.length) : "-";
    if (!/^$|^[.[]/.test(rest) || !isAbout(violation, refusal)) return false;
    if (!refusal.fields.has(violation)) refusal.fields.set(violation, path);
    return refusal.fields.get(violation) === path;
  });
}

/** The reasons that no field shows. */
export function describeRest({ refusal }: RequestForm): string {
  if (refusal === null) return "";
  const { fields, message, violations } = refusal;
  if (fields.size === 0) return message;
  const rest = violations.filter((violation) => !fields.has(violation));
  return rest.map((violation) => violation.message).join(" ");
}
