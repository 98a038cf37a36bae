import { putParameters } from "../api/client";
import type { LawParameter, LawRow, SessionState } from "../api/types";
import type { SliderRange } from "../widgets/scale";
import { Field } from "./field";

const LONGEST_LABEL = 18;

type Value = string | number | boolean | readonly number[];

/** A slider where both ends are bounded; by decades where they are far apart. */
export function rangeOf({ least, most }: LawParameter): { range?: SliderRange } {
  if (least === null || most === null) return {};
  return { range: { min: least, max: most, logarithmic: least > 0 && most / least >= 10 } };
}

/** A meaning that leaves no room for the slider stands above it, which then has the symbol. */
export const isWordy = ({ symbol, meaning }: LawParameter): boolean =>
  symbol !== "" && meaning.length > LONGEST_LABEL;

/** Of several numbers each has its place. */
export function changedAt(held: Value, index: number | null, value: number): Value {
  if (index === null || !Array.isArray(held)) return value;
  return held.map((number, at) => (at === index ? value : number));
}

function Parameter({ law, row, held }: { law: LawRow; row: LawParameter; held: Value }) {
  const unit = row.unit === "1" ? "" : row.unit;
  const places = row.kind === "numbers" ? (held as number[]).map((_, index) => index) : [null];
  const label = isWordy(row) ? row.symbol : row.meaning;
  return (
    <>
      {isWordy(row) && <p class="hint">{row.meaning}</p>}
      {places.map((index) => (
        <Field
          key={index}
          name={`parameters.${law.name}.${row.name}${index === null ? "" : `[${index}]`}`}
          label={index === null ? label : `${label} ${index + 1}`}
          {...(isWordy(row) ? { labelRest: row.meaning } : {})}
          unit={unit}
          value={index === null ? (held as number) : ((held as number[])[index] as number)}
          {...rangeOf(row)}
          send={(value) =>
            putParameters({ [law.name]: { [row.name]: changedAt(held, index, value) } })
          }
        />
      ))}
    </>
  );
}

/** A form of the parameters that a law says it has. */
export function LawForm({ law, state }: { law: LawRow; state: SessionState }) {
  const held = state.configuration.parameters[law.name] ?? {};
  const numbers = law.parameters.filter(({ kind }) => kind === "number" || kind === "numbers");
  return (
    <>
      {numbers.map((row) => (
        <Parameter
          key={row.name}
          law={law}
          row={row}
          held={(held[row.name] as Value | undefined) ?? row.default}
        />
      ))}
    </>
  );
}
