import { putParameters } from "../../core/api/client";
import type { LawParameter, LawRow, SessionState } from "../../core/api/types";
import { isWordy, labelParameter } from "../../core/state/laws";
import type { SliderRange } from "../../core/widgets/scale";
import { Undo } from "../design/summary";
import { Field } from "./field";

type Value = string | number | boolean | readonly number[];

/** A slider where both ends are bounded; by decades where they are far apart. */
export function rangeOf({ low, high }: LawParameter): { range?: SliderRange } {
  if (low === null || high === null) return {};
  return { range: { min: low, max: high, logarithmic: low > 0 && high / low >= 10 } };
}

/** Of several numbers each has its place. */
export function changedAt(held: Value, index: number | null, value: number): Value {
  if (index === null || !Array.isArray(held)) return value;
  return held.map((number, at) => (at === index ? value : number));
}

interface ParameterProps {
  /** Of the form, among all of the page. */
  name: string;
  row: LawParameter;
  held: Value;
  send: (value: Value) => Promise<SessionState>;
}

function Parameter({ name, row, held, send }: ParameterProps) {
  const unit = row.unit === "1" ? "" : row.unit;
  const places = row.kind === "numbers" ? (held as number[]).map((_, index) => index) : [null];
  return (
    <>
      {isWordy(row) && <p class="hint">{row.meaning}</p>}
      {places.map((index) => (
        <Field
          key={index}
          name={`${name}.${row.name}${index === null ? "" : `[${index}]`}`}
          label={labelParameter(row, index)}
          {...(isWordy(row) ? { labelRest: row.meaning } : {})}
          unit={unit}
          value={index === null ? (held as number) : ((held as number[])[index] as number)}
          {...rangeOf(row)}
          send={(value) => send(changedAt(held, index, value))}
        />
      ))}
    </>
  );
}

interface ParameterFieldsProps {
  law: LawRow;
  name: string;
  held: Record<string, unknown>;
  /** Takes every parameter, those that stay too. */
  send: (parameters: Record<string, unknown>) => Promise<SessionState>;
}

/** A field for each number of a law's own parameters. */
export function ParameterFields({ law, name, held, send }: ParameterFieldsProps) {
  const numbers = law.parameters.filter(({ kind }) => kind === "number" || kind === "numbers");
  return (
    <>
      {numbers.map((row) => (
        <Parameter
          key={row.name}
          name={name}
          row={row}
          held={(held[row.name] as Value | undefined) ?? row.default}
          send={(value) => send({ ...held, [row.name]: value })}
        />
      ))}
    </>
  );
}

/** What the session's law is set to, and the way back. */
export function LawForm({ law, state }: { law: LawRow; state: SessionState }) {
  return (
    <>
      <ParameterFields
        law={law}
        name={`parameters.${law.name}`}
        held={state.configuration.parameters[law.name] ?? {}}
        send={(parameters) => putParameters({ [law.name]: parameters })}
      />
      <Undo />
    </>
  );
}
