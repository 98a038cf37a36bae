import { useState } from "preact/hooks";
import { removeAllLoads, removeLoad } from "../../core/api/client";
import type { LoadRow, SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import {
  chosenForm,
  currentLoads,
  isRealBench,
  isWeight,
  nextWeightForm,
  type WeightForm,
} from "../../core/state/plant";
import { t } from "../../core/text/t";
import { Choice, Problem } from "../../core/widgets/form";
import { CustomLoad } from "./customload";
import { Group } from "./group";

const FORMS: readonly { value: Exclude<WeightForm, "torque" | "tip">; label: string }[] = [
  { value: "paper", label: t("load.paper") },
  { value: "mass", label: t("load.mass") },
];

/** A push at the tip and a wall have controls of their own. */
const hasOwnControl = ({ load }: LoadRow): boolean =>
  load.kind === "tip_push" || load.kind === "wall";

/** Whether a load acts or is scheduled that the button does not control. */
export const hasOtherLoads = (state: SessionState): boolean =>
  !currentLoads(state).every((row) => hasOwnControl(row) || (row.active && isWeight(state, row)));

function LoadRows({ state }: { state: SessionState }) {
  const rows = currentLoads(state);
  if (!hasOtherLoads(state)) return null;
  return (
    <ul class="small">
      {rows.map((row) => (
        <li key={row.id} class="spread">
          <span>
            {row.joint !== null && `${t("arm.onJoint", { joint: row.joint })}: `}
            {row.label}
            {!row.active && ` · ${t("load.comesAt", { time: Number(row.start_s.toFixed(2)) })}`}
          </span>
          <button
            type="button"
            class="quiet"
            aria-label={t("load.removeThis", { what: row.label })}
            onClick={() => void perform("load.rows", removeLoad(row.id))}
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
            {t("load.removeAll")}
          </button>
        </li>
      )}
    </ul>
  );
}

/** Form of the 3 kg in a simulation and on the emulator. */
function FormPicker({ state }: { state: SessionState }) {
  const form = nextWeightForm(state);
  if (form === "torque" || form === "tip") return null;
  return (
    <Choice
      label={t("load.form")}
      options={FORMS}
      value={form}
      onChoose={(form) => {
        chosenForm.value = form;
      }}
    />
  );
}

const words = {
  paper: t("load.paperDoes"),
  mass: t("load.massDoes"),
  torque: t("load.torqueDoes"),
  tip: t("arm.does"),
} as const;

export function Loads({ state }: { state: SessionState }) {
  const [isShown, show] = useState(false);
  if (isRealBench(state.bench)) {
    return (
      <Group title={t("load.title")} topic="load">
        <p class="hint">{t("load.markDoes")}</p>
      </Group>
    );
  }
  return (
    <Group title={t("load.title")} topic="load" aside={<FormPicker state={state} />}>
      <p class="hint is-about">{words[nextWeightForm(state)]}</p>
      <LoadRows state={state} />
      <Problem control="load.rows" />
      <details class="more" onToggle={(event) => show(event.currentTarget.open)}>
        <summary>{t("load.custom")}</summary>
        <CustomLoad isShown={isShown} />
      </details>
    </Group>
  );
}
