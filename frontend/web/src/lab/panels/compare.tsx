import { useId } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { addLane, CONTROL, toggleCompare } from "../../core/state/commands";
import { comparisonLanes, lanesToCompare } from "../../core/state/lanes";
import { titleOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { Problem } from "../../core/widgets/form";
import { ComparisonRow } from "./comparisonlanes";
import { LawPicker } from "./lawpicker";

const MAX_LANES = 4;

/** Comparison lanes: switch on and off, add, set, remove. */
export function Compare({ state }: { state: SessionState }) {
  const others = comparisonLanes(state);
  const id = useId();
  const isOn = others.length > 0;
  const isRecording = state.recording !== null;
  const isFull = state.lanes.length >= MAX_LANES;
  const most = others.length;
  const compared = isOn ? others.map(({ controller }) => controller) : lanesToCompare(state);
  if (compared.length === 0) return null;
  const names = [...new Set(compared.map(({ law }) => law))].map(titleOf).join(", ");
  const whyNotAdded = isFull ? t("comparisons.full", { most }) : t("comparisons.addHint");
  return (
    <>
      <div class="line">
        <button
          type="button"
          role="switch"
          class="button grow compare"
          aria-checked={isOn}
          aria-keyshortcuts="c"
          aria-describedby={id}
          disabled={isRecording}
          title={isRecording ? t("compare.whileRecording") : t("compare.does")}
          onClick={() => void toggleCompare(state)}
        >
          <span class="rigid compare-track" aria-hidden="true" />
          <span class="grow">{t("compare.with", { law: names })}</span>
        </button>
        <LawPicker
          label={t("comparisons.add")}
          button={t("comparisons.add")}
          title={isRecording ? t("compare.whileRecording") : whyNotAdded}
          value={null}
          isDisabled={isRecording || isFull}
          onChoose={(law) => addLane(state, law)}
        />
      </div>
      {isOn && (
        <ul class="stack tight" aria-label={t("comparisons.list")}>
          {others.map((lane) => (
            <ComparisonRow
              key={lane.id}
              state={state}
              comparison={lane}
              isRecording={isRecording}
            />
          ))}
        </ul>
      )}
      <span class="visually-hidden" id={id}>
        {isRecording ? t("compare.whileRecording") : t("compare.does")}
      </span>
      <Problem control={CONTROL.compare} />
    </>
  );
}
