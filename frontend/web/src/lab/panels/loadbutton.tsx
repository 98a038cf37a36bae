import { useState } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { CONTROL, toggleWeight } from "../../core/state/commands";
import { takesCommands } from "../../core/state/control";
import {
  formOfNext,
  hungWeights,
  isRealBench,
  nextWeight,
  nextWeightAt,
  type WeightForm,
} from "../../core/state/plant";
import { isLive } from "../../core/state/session";
import { text } from "../../core/text/en";
import { formatInput } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { EnduranceNote } from "../../hardware/endurance";

/** A mass on a cord, or the paper's torques: these have no mass and do not hang. */
function WeightPicture({ isHung, form }: { isHung: boolean; form: WeightForm }) {
  if (form !== "mass") {
    return (
      <svg class="weight" viewBox="0 0 48 48" aria-hidden="true">
        <path class="weight-ring" d="M9 36a17 17 0 1 1 30 0" />
        <path class="weight-body" d="M33 33l13 1-8 10z" />
        <text class="weight-torque" x="24" y="31" text-anchor="middle">
          {form === "paper" ? text.load.torque2 : text.load.torqueSign}
        </text>
      </svg>
    );
  }
  return (
    <svg class="weight" viewBox="0 0 48 48" aria-hidden="true">
      {isHung && <path class="weight-cord" d="M24 0v16" />}
      <circle class="weight-ring" cx="24" cy="19" r="4.5" />
      <path class="weight-body" d="M14.5 24h19l5.5 19a3 3 0 0 1-3 4H12a3 3 0 0 1-3-4z" />
      <text class="weight-text" x="24" y="41" text-anchor="middle">
        {text.load.weight}
      </text>
    </svg>
  );
}

/** Of the load that acts, else of the one that the button adds. */
function formOf(state: SessionState): WeightForm {
  const [hung] = hungWeights(state);
  if (hung === undefined || formOfNext(state) === "torque") return formOfNext(state);
  return hung.load.kind === "paper" ? "paper" : "mass";
}

function caption(state: SessionState, isHung: boolean): string {
  if (!isLive.value) return text.status.notKnown;
  if (isRealBench(state.bench)) return isHung ? text.load.marked : text.load.mark;
  const form = formOf(state);
  const torque = text.load.torqueShort(formatInput(Math.abs(state.actuator.load.torque_nm[0])));
  if (isHung && form === "torque") return torque;
  if (isHung) return form === "paper" ? text.load.acts : text.load.hangs;
  const next = nextWeightAt(state);
  if (next !== null) return text.load.comesAt(next);
  if (form === "torque") return torque;
  return form === "paper" ? text.load.paperShort : text.load.massShort;
}

function words(state: SessionState, isHung: boolean): string {
  if (isRealBench(state.bench)) return isHung ? text.load.markRemoved : text.load.markHung;
  if (formOfNext(state) === "torque") return isHung ? text.load.removeTorque : text.load.addTorque;
  return isHung ? text.load.remove : text.load.hang;
}

/** The one thing to press: hangs 3 kg on the link, or takes them off. */
export function LoadButton({ state }: { state: SessionState }) {
  const [isBusy, setBusy] = useState(false);
  const isHung = hungWeights(state).length > 0;

  const press = async () => {
    setBusy(true);
    await toggleWeight();
    setBusy(false);
  };

  return (
    <div class="load-place" tabIndex={-1}>
      <button
        type="button"
        class={`load-button ${isHung ? "is-hung" : ""}`}
        aria-keyshortcuts="l"
        disabled={isBusy || !takesCommands.value || state.status === "fault"}
        onClick={() => void press()}
      >
        <WeightPicture isHung={isHung} form={formOf(state)} />
        <span class="load-words">
          <strong>{words(state, isHung)}</strong>
          <small>{caption(state, isHung)}</small>
        </span>
      </button>
      <EnduranceNote load={isHung ? null : nextWeight(state)} />
      <Problem control={CONTROL.load} />
    </div>
  );
}
