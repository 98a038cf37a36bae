import { useState } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { CONTROL, toggleWeight } from "../../core/state/commands";
import { takesCommands } from "../../core/state/control";
import {
  activeWeights,
  hungAtTip,
  isRealBench,
  nextWeight,
  nextWeightAt,
  nextWeightForm,
  tipMassKg,
  type WeightForm,
} from "../../core/state/plant";
import { isLive } from "../../core/state/session";
import { t } from "../../core/text/t";
import { formatInput } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { EnduranceNote } from "../../hardware/endurance";

/** A hanging mass, or the paper's torques, which have no mass. */
function WeightPicture({ isActive, form }: { isActive: boolean; form: WeightForm }) {
  if (form !== "mass" && form !== "tip") {
    return (
      <svg class="rigid weight" viewBox="0 0 48 48" aria-hidden="true">
        <path class="outline" d="M9 36a17 17 0 1 1 30 0" />
        <path class="solid" d="M33 33l13 1-8 10z" />
        <text class="solid" x="24" y="31" text-anchor="middle">
          {form === "paper" ? t("load.torque2") : t("load.torqueSign")}
        </text>
      </svg>
    );
  }
  return (
    <svg class="rigid weight" viewBox="0 0 48 48" aria-hidden="true">
      {isActive && <path class="outline" d="M24 0v16" />}
      <circle class="outline" cx="24" cy="19" r="4.5" />
      <path class="solid" d="M14.5 24h19l5.5 19a3 3 0 0 1-3 4H12a3 3 0 0 1-3-4z" />
      <text class="weight-text" x="24" y="41" text-anchor="middle">
        {form === "mass" ? t("load.weight") : t("load.massSign")}
      </text>
    </svg>
  );
}

/** Text of the acting load, otherwise of the one that the button adds. */
function formOf(state: SessionState): WeightForm {
  const [hung] = activeWeights(state);
  const next = nextWeightForm(state);
  if (hung === undefined || next === "torque" || next === "tip") return next;
  return hung.load.kind === "paper" ? "paper" : "mass";
}

function caption(state: SessionState, isActive: boolean): string {
  if (!isLive.value) return t("status.notKnown");
  if (isRealBench(state.bench)) return isActive ? t("load.marked") : t("load.mark");
  const form = formOf(state);
  if (form === "tip") return t("arm.short");
  const torque = t("load.torqueShort", {
    torque: formatInput(Math.abs(state.actuator.load.torque_nm[0])),
  });
  if (isActive && form === "torque") return torque;
  if (isActive) return form === "paper" ? t("load.acts") : t("load.hangs");
  const next = nextWeightAt(state);
  if (next !== null) return t("load.comesAt", { time: Number(next.toFixed(2)) });
  if (form === "torque") return torque;
  return form === "paper" ? t("load.paperShort") : t("load.massShort");
}

function words(state: SessionState, isActive: boolean): string {
  if (nextWeightForm(state) === "tip") {
    const mass = formatInput(hungAtTip(state) || tipMassKg.value);
    return isActive ? t("arm.remove", { mass }) : t("arm.hang", { mass });
  }
  if (isRealBench(state.bench)) return isActive ? t("load.markRemoved") : t("load.markHung");
  if (nextWeightForm(state) === "torque")
    return isActive ? t("load.removeTorque") : t("load.addTorque");
  return isActive ? t("load.remove") : t("load.hang");
}

/** The main button: adds or removes the 3 kg on the link. */
export function LoadButton({ state }: { state: SessionState }) {
  const [isBusy, setBusy] = useState(false);
  const isActive = activeWeights(state).length > 0;

  const press = async () => {
    setBusy(true);
    await toggleWeight();
    setBusy(false);
  };

  return (
    <div class="load-place" tabIndex={-1}>
      <button
        type="button"
        class={`line loose load-button ${isActive ? "is-hung" : ""}`}
        aria-keyshortcuts="l"
        disabled={isBusy || !takesCommands.value || state.status === "fault"}
        onClick={() => void press()}
      >
        <WeightPicture isActive={isActive} form={formOf(state)} />
        <span class="load-words">
          <strong>{words(state, isActive)}</strong>
          <small>{caption(state, isActive)}</small>
        </span>
      </button>
      <EnduranceNote load={isActive ? null : nextWeight(state)} />
      <Problem control={CONTROL.load} />
    </div>
  );
}
