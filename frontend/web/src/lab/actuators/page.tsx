/** The actuators of the lab: their parameters, a private session of one, its datasheet. */
import { useEffect, useState } from "preact/hooks";
import { openActuator } from "../../core/api/actuators";
import type { ActuatorRow } from "../../core/api/types";
import { explain } from "../../core/state/actions";
import { actuators, SVSA } from "../../core/state/actuators";
import { text } from "../../core/text/en";
import { formatInput } from "../../core/units";
import { Page } from "../../core/widgets/desk";
import { Choice } from "../../core/widgets/form";
import { Table } from "../../core/widgets/tables";
import { goTo, place } from "../../runs/list/place";
import { DatasheetCard } from "./datasheet";

const words = text.actuators;

const shown = (value: number | string): string =>
  typeof value === "number" ? formatInput(value) : value;

function Parameters({ actuator }: { actuator: ActuatorRow }) {
  return (
    <Table label={words.parameters} caption={words.parameters} heads={words.heads}>
      {actuator.parameters.map((one) => (
        <tr key={one.name}>
          <th scope="row">{one.meaning}</th>
          <td>{shown(one.value)}</td>
          <td>{shown(one.nominal)}</td>
          <td>{one.unit === "1" ? "" : one.unit}</td>
          <td class={one.assumed ? "muted" : ""}>{one.source}</td>
        </tr>
      ))}
    </Table>
  );
}

function describeRange({ limits, only_stiffness_nm_per_rad: only }: ActuatorRow): string {
  const torque = formatInput(limits.torque1_nm);
  if (only !== null) return words.fixed(formatInput(only), torque);
  const [low, high] = [limits.stiffness_min_nm_per_rad, limits.stiffness_max_nm_per_rad];
  return words.facts(formatInput(low), formatInput(high), torque);
}

interface ActuatorProps {
  actuator: ActuatorRow;
  onProblem: (problem: string) => void;
}

function Actuator({ actuator, onProblem }: ActuatorProps) {
  const [isOpening, setOpening] = useState(false);
  const open = async () => {
    setOpening(true);
    onProblem("");
    try {
      const { session } = await openActuator(actuator.name);
      location.assign(`${location.pathname}?session=${encodeURIComponent(session)}`);
    } catch (error) {
      onProblem(explain(error));
      setOpening(false);
    }
  };
  return (
    <section class="surface card actuator-card" aria-label={actuator.title}>
      <div class="spread">
        <div>
          <h3>{actuator.title}</h3>
          <p class="hint">{actuator.source}</p>
        </div>
        <button
          type="button"
          class="button is-primary"
          title={words.openHint}
          disabled={isOpening}
          onClick={() => void open()}
        >
          {isOpening ? words.opening : words.open}
        </button>
      </div>
      <p>{describeRange(actuator)}</p>
      {actuator.name === SVSA && <p class="hint">{words.paper}</p>}
      <Parameters actuator={actuator} />
    </section>
  );
}

/** The actuator that the address names, else the first. */
export function ActuatorsPage() {
  const at = place.value;
  const named = at.kind === "actuators" ? at.actuator : "";
  const [problem, setProblem] = useState("");
  useEffect(() => setProblem(""), [named]);
  const found = actuators.value ?? [];
  const actuator = found.find(({ name }) => name === named) ?? found[0];
  return (
    <Page title={words.title} lead={words.lead} problem={problem}>
      {actuator === undefined ? (
        <p class="hint">{words.loading}</p>
      ) : (
        <>
          <div class="actuators-choice">
            <Choice
              label={words.choose}
              options={found.map(({ name, title }) => ({ value: name, label: title }))}
              value={actuator.name}
              onChoose={(name) => goTo({ kind: "actuators", actuator: name })}
            />
          </div>
          <Actuator key={actuator.name} actuator={actuator} onProblem={setProblem} />
          <DatasheetCard key={`${actuator.name} datasheet`} actuator={actuator} />
        </>
      )}
    </Page>
  );
}
