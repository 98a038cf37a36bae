import { useId } from "preact/hooks";
import { patchActuator, patchNominal } from "../../core/api/client";
import type { ActuatorParameters, Configuration } from "../../core/api/types";
import { type ServerNumber, useServerNumber } from "../../core/forms/servernumber";
import { PARAMETERS } from "../../core/quantities";
import type { Demand } from "../../core/readnumber";
import { quantityOfSchema, schemaOfParameter } from "../../core/schema";
import { perform } from "../../core/state/actions";
import { describeActuator, nameOfActuator, patchOf, SVSA } from "../../core/state/actuators";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { NumberInput } from "../../core/widgets/numberinput";

/** Format of a parameter in the table. */
interface Row {
  key: string;
  symbol: string;
  meaning: string;
  demand: Demand;
}
const COLUMNS = [
  { column: "actuator", patch: patchActuator },
  { column: "nominal", patch: patchNominal },
] as const;

interface CellProps extends ServerNumber {
  label: string;
  describedBy: string;
  demand: Demand;
}

function Cell({ label, describedBy, demand, ...held }: CellProps) {
  const { shown, commit, edits } = useServerNumber(held);
  return (
    <td {...edits}>
      <NumberInput
        aria-label={label}
        describedBy={describedBy}
        {...demand}
        value={shown}
        onCommit={commit}
      />
    </td>
  );
}

function differenceOf(model: number, actual: number): string {
  if (actual === 0 || model === actual) return model === actual ? "0" : "";
  const percent = 100 * (model / actual - 1);
  const digits = Math.abs(percent) < 10 ? 1 : 0;
  return t("realism.percent", {
    value: `${percent > 0 ? "+" : ""}${formatNumber(percent, 3, digits)}`,
  });
}

type Models = Pick<Configuration, "actuator" | "nominal">;
const numberOf = (values: ActuatorParameters, key: string): number => Number(values[key]);

/** Numbers of the actuator; those that every actuator has with the page's symbols and labels. */
function listRows({ actuator }: Models): Row[] {
  const name = nameOfActuator(actuator);
  const numbers = (describeActuator(name)?.parameters ?? []).filter(
    (row) => typeof actuator[row.name] === "number" && (row.name in PARAMETERS || name !== SVSA),
  );
  return numbers.map((row) => {
    const key = row.name as keyof typeof PARAMETERS;
    const [symbol = "", meaning = row.meaning] =
      key in PARAMETERS ? [PARAMETERS[key][0], t(`realism.names.${key}`)] : [];
    const { unit, min, max } = quantityOfSchema({ ...schemaOfParameter(row), isSi: true });
    return {
      key,
      symbol,
      meaning: unit === "" ? meaning : `${meaning}, ${unit}`,
      demand: { label: `${symbol} ${meaning}`.trim(), unit, min, max },
    };
  });
}

/** Whether the controller's model equals the plant. */
export const isExact = ({ actuator, nominal }: Models): boolean =>
  Object.keys(actuator).every((key) => actuator[key] === nominal[key]);

/** Parameters of the plant, and of the controller's model. */
export function ParameterTable({ actuator, nominal }: Models) {
  const id = useId();
  const held = { actuator, nominal };
  const rows = listRows(held);
  const isModelExact = isExact(held);
  const nameOf = (key: string, column: string) => `realism.${column}.${key}`;
  return (
    <>
      <p class="hint">{t("realism.parametersHint")}</p>
      <table class="small parameters">
        <thead>
          <tr>
            <th scope="col">{t("realism.parameter")}</th>
            <th scope="col">{t("realism.actuator")}</th>
            <th scope="col">{t("realism.nominal")}</th>
            <th scope="col">{t("realism.difference")}</th>
          </tr>
        </thead>
        <tbody>
          {rows.map(({ key, symbol, meaning, demand }) => (
            <tr key={key}>
              <th scope="row">
                <i>{symbol}</i> <small class="block tiny">{meaning}</small>
              </th>
              {COLUMNS.map(({ column, patch }) => (
                <Cell
                  key={column}
                  name={nameOf(key, column)}
                  label={t("realism.cell", {
                    name: `${symbol} ${meaning}`.trim(),
                    column: t(`realism.${column}`),
                  })}
                  describedBy={id}
                  demand={{
                    ...demand,
                    label: t("realism.cell", {
                      name: demand.label ?? "",
                      column: t(`realism.${column}`),
                    }),
                  }}
                  value={numberOf(held[column], key)}
                  send={(value) => patch({ [key]: value })}
                />
              ))}
              <td>{differenceOf(numberOf(nominal, key), numberOf(actuator, key))}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <div id={id}>
        {rows.flatMap(({ key }) =>
          COLUMNS.map(({ column }) => <Problem key={column + key} control={nameOf(key, column)} />),
        )}
      </div>
      <button
        type="button"
        class="button"
        disabled={isModelExact}
        onClick={() => void perform("realism.exact", patchNominal(patchOf(actuator)))}
      >
        {t("realism.exact")}
      </button>
      <Problem control="realism.exact" />
    </>
  );
}
