import "../../browserless";
import { expect, it } from "vitest";
import api from "../../../../../docs/openapi.json";
import { resolveReferences } from "../../../requests";
import { RefusedError, type Violation } from "../../../src/core/api/errors";
import {
  changeAt,
  changeKind,
  firstOf,
  kindsOf,
  quantityOfSchema,
  type Schema,
  schemaOfKind,
} from "../../../src/core/schema";

const read = (name: keyof typeof api.components.schemas): Schema =>
  resolveReferences(api.components.schemas[name], api.components.schemas) as Schema;

it("a form begins with the defaults of its schema, without optional fields", () => {
  expect(firstOf(read("StudyRequest"))).toEqual({});
  const tuning = { kind: "tuning", law: undefined, budget: 128, seed: 0, held: {} };
  expect(firstOf(read("TuningRequest"))).toEqual(tuning);
});

it("a value of another kind keeps the common fields and begins with examples", () => {
  const kinds = kindsOf(read("Adversary").properties?.terms?.items as Schema);
  expect([...kinds.values()].map(({ title }) => title)).toEqual(["Step", "Pulse", "Sine"]);
  const pulse = {
    kind: "pulse",
    bodies: ["motor1"],
    torque_nm: 3,
    start_s: [1, 2],
    duration_s: [0.1, 1],
  };
  const { duration_s: _, ...shared } = pulse;
  const sine = { ...shared, kind: "sine", frequency_hz: [0.1, 20] };
  expect(changeKind(pulse, kinds.get("sine")?.schema as Schema)).toEqual(sine);
});

it("a kind that the server describes at run time is a form with its defaults", () => {
  const row = { symbol: "", kind: "number", default: null, low: null } as const;
  const angle = { ...row, name: "amplitude_rad", symbol: "A", meaning: "Amplitude", unit: "rad" };
  const time = { ...row, name: "duration_s", meaning: "Duration", unit: "s", low: 0, high: 3600 };
  const form = [
    { parameter: { ...angle, high: 6.3 }, first: 0.2 },
    { parameter: time, first: 5 },
  ];
  const schema = schemaOfKind("chirp", [{ kind: "chirp", form }]);
  expect(firstOf(schema)).toEqual({ kind: "chirp", amplitude_rad: 0.2, duration_s: 5 });
  expect(schema.properties?.amplitude_rad).toMatchObject({ title: "A", description: "Amplitude" });
  const duration = quantityOfSchema(schema.properties?.duration_s ?? {});
  expect(duration).toEqual({ label: "Duration", unit: "s", min: 0, max: 3600 });
  expect(firstOf(schemaOfKind("gone", []))).toEqual({ kind: "gone" });
});

it("a value is changed at its path, and nothing else", () => {
  const held = { kind: "sine", noise: { std_rad: 1 }, rates: [1, 2, 3] };
  expect(changeAt(held, "rates[1]", 5)).toEqual({ ...held, rates: [1, 5, 3] });
  expect(changeAt(held, "noise.std_rad", 2)).toEqual({ ...held, noise: { std_rad: 2 } });
  expect(held.rates).toEqual([1, 2, 3]);
});

it("an angle has its bounds in degrees, a short time in milliseconds", () => {
  const angle = { title: "Offset", unit: "rad", minimum: -Math.PI, maximum: Math.PI };
  expect(quantityOfSchema(angle)).toMatchObject({
    label: "Offset",
    unit: "deg",
    min: -180,
    max: 180,
  });
  const lag = { title: "Lag", unit: "s", exclusiveMinimum: 0, maximum: 0.01 };
  expect(quantityOfSchema(lag)).toMatchObject({ unit: "ms", min: 0, max: 10 });
});

it("a violation is shown at the innermost field that sent its value, until it changes", async () => {
  const { describeRest, violationsAt } = await import("../../../src/core/forms/request");
  const violation = (name: string, value: unknown) =>
    ({ name, value, message: `${name}!` }) as Violation;
  const body = { runs: 3, terms: [{ start_s: [2, 1] }], text: "runs = 0" };
  const inner = violation("terms[0].start_s[1]", 1);
  const ofText = violation("runs", 0);
  const { message, violations } = new RefusedError(422, "line 1: runs!", [inner, ofText]);
  const refusal = { body, message, violations, fields: new Map() };
  const form = { body, refusal } as never;
  expect(violationsAt(form, "runs")).toEqual([]);
  expect(describeRest(form)).toBe("line 1: runs!");
  expect(violationsAt(form, "terms[0].start_s")).toEqual([inner]);
  expect(violationsAt(form, "terms")).toEqual([]);
  expect(describeRest(form)).toBe("runs!");
  const edited = { body: { ...body, terms: [{ start_s: [1, 2] }] }, refusal } as never;
  expect(violationsAt(edited, "terms[0].start_s")).toEqual([]);
});
