import type { SessionRequest } from "../../core/api/client";
import { putParameters } from "../../core/api/client";
import type { LawParameter, LawRow, SessionState } from "../../core/api/types";
import { hasLongMeaning, labelParameter } from "../../core/state/laws";
import type { SliderRange } from "../../core/widgets/scale";
import { Undo } from "../design/summary";
import { Field } from "./field";

type Value = string | number | boolean | readonly number[];

/** A slider if both ends are bounded; logarithmic if they are decades apart. */
export function rangeOf({ low, high }: LawParameter): { range?: SliderRange } {
  if (low === null || high === null) return {};
  return { range: { min: low, max: high, logarithmic: low > 0 && high / low >= 10 } };
}

/** Index, for a parameter of several numbers. */
export function changedAt(held: Value, index: number | null, value: number): Value {
  if (index === null || !Array.isArray(held)) return value;
  return held.map((number, at) => (at === index ? value : number));
}

interface ParameterProps {
  /** Name of the form, unique on the page. */
  name: string;
  row: LawParameter;
  held: Value;
  send: (value: Value) => SessionRequest;
}

function Parameter({ name, row, held, send }: ParameterProps) {
  const unit = row.unit === "1" ? "" : row.unit;
  const places = row.kind === "numbers" ? (held as number[]).map((_, index) => index) : [null];
  return (
    <>
      {hasLongMeaning(row) && <p class="hint">{row.meaning}</p>}
      {places.map((index) => (
        <Field
          key={index}
          name={`${name}.${row.name}${index === null ? "" : `[${index}]`}`}
          label={labelParameter(row, index)}
          {...(hasLongMeaning(row) ? { labelRest: row.meaning } : {})}
          unit={unit}
          value={index === null ? (held as number) : ((held as number[])[index] as number)}
          min={row.low ?? undefined}
          max={row.high ?? undefined}
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
  /** Receives all parameters, including the unchanged ones. */
  send: (parameters: Record<string, unknown>) => SessionRequest;
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

/** The parameters of the session's law, and a button to restore the defaults. */
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
