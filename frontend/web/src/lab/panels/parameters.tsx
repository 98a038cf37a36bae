import { useId } from "preact/hooks";
import { type ActuatorPatch, patchActuator, patchNominal } from "../../core/api/client";
import type { ActuatorParameters, Configuration } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { type HeldNumber, useDraft } from "./draft";

const words = text.realism;
type Key = keyof typeof words.names;
const KEYS = Object.keys(words.names) as Key[];
const COLUMNS = [
  { column: "actuator", patch: patchActuator },
  { column: "nominal", patch: patchNominal },
] as const;

function Cell({
  label,
  describedBy,
  ...held
}: HeldNumber & { label: string; describedBy: string }) {
  const { inputProps } = useDraft(held);
  return (
    <td>
      <input aria-label={label} aria-describedby={describedBy} {...inputProps} />
    </td>
  );
}

function differenceOf(model: number, actual: number): string {
  if (actual === 0 || model === actual) return model === actual ? "0" : "";
  const percent = 100 * (model / actual - 1);
  const digits = Math.abs(percent) < 10 ? 1 : 0;
  return words.percent(`${percent > 0 ? "+" : ""}${formatNumber(percent, 3, digits)}`);
}

interface ParameterTableProps {
  actuator: ActuatorParameters;
  nominal: ActuatorParameters;
}

/** Whether the controller's model is the plant. */
export const isExact = ({
  actuator,
  nominal,
}: Pick<Configuration, "actuator" | "nominal">): boolean =>
  KEYS.every((key) => actuator[key] === nominal[key]);

/** What the plant is, and what the controller takes it for. */
export function ParameterTable({ actuator, nominal }: ParameterTableProps) {
  const id = useId();
  const held = { actuator, nominal };
  const isModelExact = isExact(held);
  const nameOf = (key: Key, column: string) => `realism.${column}.${key}`;
  return (
    <>
      <p class="hint">{words.parametersHint}</p>
      <table class="parameters">
        <thead>
          <tr>
            <th scope="col">{words.parameter}</th>
            <th scope="col">{words.actuator}</th>
            <th scope="col">{words.nominal}</th>
            <th scope="col">{words.difference}</th>
          </tr>
        </thead>
        <tbody>
          {KEYS.map((key) => {
            const [symbol, name, unit] = words.names[key];
            const meaning = `${name}, ${unit}`;
            return (
              <tr key={key}>
                <th scope="row">
                  <i>{symbol}</i> <small>{meaning}</small>
                </th>
                {COLUMNS.map(({ column, patch }) => (
                  <Cell
                    key={column}
                    name={nameOf(key, column)}
                    label={words.cell(`${symbol} ${meaning}`, words[column])}
                    describedBy={id}
                    value={held[column][key]}
                    send={(value) => patch({ [key]: value } as ActuatorPatch)}
                  />
                ))}
                <td>{differenceOf(nominal[key], actuator[key])}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
      <div id={id}>
        {KEYS.flatMap((key) =>
          COLUMNS.map(({ column }) => <Problem key={column + key} control={nameOf(key, column)} />),
        )}
      </div>
      <button
        type="button"
        class="button"
        disabled={isModelExact}
        onClick={() => void perform("realism.exact", () => patchNominal(actuator))}
      >
        {words.exact}
      </button>
      <Problem control="realism.exact" />
    </>
  );
}
