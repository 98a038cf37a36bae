import { useId } from "preact/hooks";
import { patchActuator, patchNominal } from "../../core/api/client";
import type { ActuatorParameters, Configuration } from "../../core/api/types";
import { PARAMETERS } from "../../core/quantities";
import type { Demand } from "../../core/readnumber";
import { perform } from "../../core/state/actions";
import { describeActuator, nameOfActuator, patchOf, SVSA } from "../../core/state/actuators";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { NumberInput } from "../../core/widgets/numberinput";
import { type ServerNumber, useServerNumber } from "./draft";

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

/** Numbers of the actuator, with the page's shorter labels if there are any. */
function listRows({ actuator }: Models): Row[] {
  const name = nameOfActuator(actuator);
  const described = describeActuator(name)?.parameters ?? [];
  const demandOf = (key: string, label: string, unit: string): Demand => {
    const row = described.find((parameter) => parameter.name === key);
    return { label, unit, min: row?.low ?? undefined, max: row?.high ?? undefined };
  };
  const common = (Object.keys(PARAMETERS) as (keyof typeof PARAMETERS)[]).filter(
    (key) => typeof actuator[key] === "number",
  );
  const own = described.filter(
    ({ name: key, kind }) => name !== SVSA && kind === "number" && !(key in PARAMETERS),
  );
  return [
    ...common.map((key) => {
      const [symbol, unit] = PARAMETERS[key];
      const meaning = t(`realism.names.${key}`);
      const demand = demandOf(key, `${symbol} ${meaning}`, unit);
      return { key, symbol, meaning: `${meaning}, ${unit}`, demand };
    }),
    ...own.map(({ name: key, meaning, unit }) => ({
      key,
      symbol: "",
      meaning: unit === "1" ? meaning : `${meaning}, ${unit}`,
      demand: demandOf(key, meaning, unit === "1" ? "" : unit),
    })),
  ];
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
