/** The actuators of the lab and the arm: parameters, private sessions, datasheets. */
import { useEffect, useState } from "preact/hooks";
import { openActuator, readActuator } from "../../core/api/actuators";
import type { ActuatorRow } from "../../core/api/types";
import { actuators, SVSA } from "../../core/state/actuators";
import { t } from "../../core/text/t";
import { formatInput } from "../../core/units";
import { Choice } from "../../core/widgets/form";
import { Page } from "../../core/widgets/pagelayout";
import { MathSymbol } from "../../core/widgets/symbol";
import { Table } from "../../core/widgets/tables";
import { goTo, place } from "../../runs/list/place";
import { ARM, ArmCard } from "./armcard";
import { DatasheetCard } from "./datasheet";
import { CardHead, useOpening } from "./opening";

const POLL_MS = 1000;

const shown = (value: number | string): string =>
  typeof value === "number" ? formatInput(value) : value;

function Parameters({ actuator }: { actuator: ActuatorRow }) {
  return (
    <Table
      label={t("actuators.parameters")}
      caption={t("actuators.parameters")}
      heads={t("actuators.heads", { returnObjects: true })}
    >
      {actuator.parameters.map((parameter) => (
        <tr key={parameter.name}>
          <th scope="row">
            <MathSymbol text={parameter.meaning} />
          </th>
          <td>{shown(parameter.value)}</td>
          <td>{shown(parameter.nominal)}</td>
          <td>{parameter.unit === "1" ? "" : parameter.unit}</td>
          <td class={parameter.assumed ? "muted" : ""}>
            <MathSymbol text={parameter.source} />
          </td>
        </tr>
      ))}
    </Table>
  );
}

function describeRange({ limits, only_stiffness_nm_per_rad: only }: ActuatorRow): string {
  const torque = formatInput(limits.torque1_nm);
  if (only !== null) return t("actuators.fixed", { sigma: formatInput(only), torque });
  const [low, high] = [limits.stiffness_min_nm_per_rad, limits.stiffness_max_nm_per_rad];
  return t("actuators.facts", { low: formatInput(low), high: formatInput(high), torque });
}

interface ActuatorProps {
  actuator: ActuatorRow;
  onProblem: (problem: string) => void;
}

/** How long the compiler has worked for the session that is being opened, s. */
function useCompiling(name: string, isWaiting: boolean): number {
  const [seconds, setSeconds] = useState(0);
  useEffect(() => {
    if (!isWaiting) return;
    const timer = setInterval(() => {
      readActuator(name).then(
        ({ compiling_s }) => setSeconds(compiling_s ?? 0),
        () => setSeconds(0), // The answer to the session itself states the problem.
      );
    }, POLL_MS);
    return () => clearInterval(timer);
  }, [name, isWaiting]);
  return seconds;
}

function Actuator({ actuator, onProblem }: ActuatorProps) {
  const [isOpening, open] = useOpening(() => openActuator(actuator.name), onProblem);
  const seconds = useCompiling(actuator.name, isOpening && !actuator.is_compiled);
  const opening = actuator.is_compiled
    ? t("actuators.opening")
    : seconds < 1
      ? t("actuators.compiling", { title: actuator.title })
      : t("actuators.compilingFor", { title: actuator.title, seconds: Math.round(seconds) });
  return (
    <section class="surface stack card" aria-label={actuator.title}>
      <CardHead
        title={actuator.title}
        hint={actuator.source}
        openHint={t("actuators.openHint")}
        label={isOpening ? opening : t("actuators.open")}
        isOpening={isOpening}
        onOpen={open}
      />
      <p>{describeRange(actuator)}</p>
      {actuator.name === SVSA && <p class="hint">{t("actuators.paper")}</p>}
      <Parameters actuator={actuator} />
    </section>
  );
}

/** The actuator in the address, or the arm; otherwise the first actuator. */
export function ActuatorsPage() {
  const at = place.value;
  const named = at.kind === "actuators" ? at.actuator : "";
  const isOfArm = named === ARM;
  const [problem, setProblem] = useState("");
  useEffect(() => setProblem(""), [named]);
  const rows = actuators.value ?? [];
  const actuator = rows.find(({ name }) => name === named) ?? rows[0];
  return (
    <Page title={t("actuators.title")} lead={t("actuators.lead")} problem={problem}>
      {actuator === undefined ? (
        <p class="hint">{t("actuators.loading")}</p>
      ) : (
        <>
          <div>
            <Choice
              label={t("actuators.choose")}
              options={[
                ...rows.map(({ name, title }) => ({ value: name, label: title })),
                { value: ARM, label: t("arm.name") },
              ]}
              value={isOfArm ? ARM : actuator.name}
              onChoose={(name) => goTo({ kind: "actuators", actuator: name })}
            />
          </div>
          {isOfArm ? (
            <ArmCard onProblem={setProblem} />
          ) : (
            <>
              <Actuator key={actuator.name} actuator={actuator} onProblem={setProblem} />
              <DatasheetCard key={`${actuator.name} datasheet`} actuator={actuator} />
            </>
          )}
        </>
      )}
    </Page>
  );
}
