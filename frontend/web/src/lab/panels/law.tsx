import type { SessionRequest } from "../../core/api/client";
import { putParameters } from "../../core/api/client";
import type { LawParameter, LawRow, SessionState } from "../../core/api/types";
import { LiveFields } from "../../core/forms/fields";
import { changeAt, type Schema, schemaOfParameter } from "../../core/schema";
import { Undo } from "../design/summary";

const MAX_LABEL_LENGTH = 18;

/** In SI, as in the law's equation; a slider if both ends are bounded. */
function numberOf(row: LawParameter, index: number | null): Schema {
  const { symbol, meaning, low, high } = row;
  // A meaning that is too long for the slider's line is above it; the line then has the symbol.
  const isLong = symbol !== "" && meaning.length > MAX_LABEL_LENGTH;
  const { description: _, ...own } = schemaOfParameter(row);
  const isDecades = low !== null && high !== null && low > 0 && high / low >= 10;
  const slider = low !== null && high !== null && { min: low, max: high, logarithmic: isDecades };
  const label = (text: string) => (index === null ? text : `${text} ${index + 1}`);
  return {
    ...own,
    title: isLong ? meaning : label(meaning),
    isSi: true,
    ...(isLong && { symbol: label(symbol) }),
    ...(isLong && !index && { about: meaning }),
    ...(slider && { slider }),
  };
}

/** The fields of a law's numbers. */
export const schemaOfLaw = ({ parameters }: LawRow): Schema => ({
  properties: Object.fromEntries(
    parameters.flatMap((row): [string, Schema][] => {
      if (row.kind === "number") return [[row.name, numberOf(row, null)]];
      if (row.kind !== "numbers") return [];
      const items = row.default as readonly number[];
      return [[row.name, { prefixItems: items.map((_, index) => numberOf(row, index)) }]];
    }),
  ),
});

interface ParameterFieldsProps {
  law: LawRow;
  name: string;
  held: Record<string, unknown>;
  /** Receives all parameters, including the unchanged ones. */
  send: (parameters: Record<string, unknown>) => SessionRequest;
}

/** A field for each number of a law's own parameters. */
export function ParameterFields({ law, name, held, send }: ParameterFieldsProps) {
  const defaults = law.parameters.map((row) => [row.name, row.default] as const);
  const values = { ...Object.fromEntries(defaults), ...held };
  return (
    <LiveFields
      name={name}
      schema={schemaOfLaw(law)}
      value={values}
      send={(path, value) => send(changeAt(values, path, value))}
    />
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
