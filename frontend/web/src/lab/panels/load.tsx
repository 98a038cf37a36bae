import { useState } from "preact/hooks";
import { removeAllLoads, removeLoad } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import {
  chosenForm,
  formOfNext,
  isRealBench,
  isWeight,
  presentLoads,
  type WeightForm,
} from "../../core/state/plant";
import { text } from "../../core/text/en";
import { Choice, Problem } from "../../core/widgets/form";
import { CustomLoad } from "./customload";
import { Group } from "./group";

const FORMS: readonly { value: Exclude<WeightForm, "torque">; label: string }[] = [
  { value: "paper", label: text.load.paper },
  { value: "mass", label: text.load.mass },
];

/** Whether a load acts or comes that is not the button's. */
export const hasOtherLoads = (state: SessionState): boolean =>
  !presentLoads(state).every((row) => row.active && isWeight(state, row));

function LoadRows({ state }: { state: SessionState }) {
  const rows = presentLoads(state);
  if (!hasOtherLoads(state)) return null;
  return (
    <ul class="load-rows">
      {rows.map((row) => (
        <li key={row.id}>
          <span>
            {row.label}
            {!row.active && ` · ${text.load.comesAt(row.start_s)}`}
          </span>
          <button
            type="button"
            class="quiet"
            aria-label={text.load.removeThis(row.label)}
            onClick={() => void perform("load.rows", () => removeLoad(row.id))}
          >
            ✕
          </button>
        </li>
      ))}
      {rows.length > 1 && (
        <li>
          <button
            type="button"
            class="quiet"
            onClick={() => void perform("load.rows", removeAllLoads)}
          >
            {text.load.removeAll}
          </button>
        </li>
      )}
    </ul>
  );
}

/** What 3 kg are in a simulation and on the emulator. */
function FormPicker({ state }: { state: SessionState }) {
  const form = formOfNext(state);
  if (form === "torque") return null;
  return (
    <Choice
      label={text.load.form}
      options={FORMS}
      value={form}
      onChoose={(form) => {
        chosenForm.value = form;
      }}
    />
  );
}

const words = {
  paper: text.load.paperDoes,
  mass: text.load.massDoes,
  torque: text.load.torqueDoes,
} as const;

export function Loads({ state }: { state: SessionState }) {
  const [isShown, show] = useState(false);
  if (isRealBench(state.bench)) {
    return (
      <Group title={text.load.title} topic="load">
        <p class="hint">{text.load.markDoes}</p>
      </Group>
    );
  }
  return (
    <Group title={text.load.title} topic="load" aside={<FormPicker state={state} />}>
      <p class="hint is-about">{words[formOfNext(state)]}</p>
      <LoadRows state={state} />
      <Problem control="load.rows" />
      <details class="more" onToggle={(event) => show(event.currentTarget.open)}>
        <summary>{text.load.custom}</summary>
        <CustomLoad isShown={isShown} />
      </details>
    </Group>
  );
}
