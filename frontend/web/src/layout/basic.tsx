/** The basic view of the lab, and the switch to all controls. */
import { computed } from "@preact/signals";
import { areAllControlsOn, toggleAllControls } from "../core/state/preferences";
import { session } from "../core/state/session";
import { t } from "../core/text/t";
import { place } from "../runs/list/place";

/** An exercise lists the controls that it needs, and the operator of a bench needs all of them. */
const hasChoice = computed(() => place.value.kind === "lab" && session.value?.bench === null);

export const isBasic = computed(() => hasChoice.value && !areAllControlsOn.value);

export function AllControlsSwitch() {
  if (!hasChoice.value) return null;
  return (
    <button
      type="button"
      role="switch"
      class="button end all-controls"
      aria-checked={areAllControlsOn.value}
      title={t("allControls.hint")}
      onClick={toggleAllControls}
    >
      {t("allControls.all")}
      <span class={areAllControlsOn.value ? "roomy" : ""}> {t("allControls.controls")}</span>
    </button>
  );
}
