import { useId, useState } from "preact/hooks";
import { putLane } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { Swatch } from "../../core/plots/legend";
import { lineStyleOfLane } from "../../core/plots/linestyles";
import { perform } from "../../core/state/actions";
import { CONTROL, removeLane } from "../../core/state/commands";
import { type ComparisonLane, hasOwnSettings } from "../../core/state/lanes";
import { lawOf, titleOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { LaneForm } from "./laneform";
import { LawPicker } from "./lawpicker";

interface ComparisonLanesProps {
  state: SessionState;
  comparison: ComparisonLane;
  isRecording: boolean;
}

/** A comparison lane: its law, its settings, and its removal. */
export function ComparisonRow({ state, comparison, isRecording }: ComparisonLanesProps) {
  const { lane, name, lineStyle, controller } = comparison;
  const [isOpen, setOpen] = useState(false);
  const id = useId();
  const law = lawOf(controller.law);
  const title = titleOf(controller.law);
  const label = name.startsWith(title) ? name.slice(title.length).trim() : name;
  return (
    <li>
      <div class="line comparison-row">
        <Swatch look={lineStyleOfLane(lineStyle, false)} />
        <LawPicker
          label={t("comparisons.law", { name })}
          title={t("comparisons.lawHint")}
          value={controller.law}
          button={title}
          onChoose={(next) => perform(CONTROL.compare, putLane(lane, { law: next }))}
        />
        <span class="hint grow breaks">
          {label || (hasOwnSettings(controller) ? t("comparisons.own") : "")}
        </span>
        <button
          type="button"
          class="quiet"
          aria-expanded={isOpen}
          aria-controls={id}
          aria-label={t("comparisons.set", { name })}
          title={t("comparisons.setHint")}
          onClick={() => setOpen(!isOpen)}
        >
          <svg viewBox="0 0 16 16" aria-hidden="true">
            <path d="M1 3.2h6.2a2 2 0 0 1 3.6 0H15v1.6h-4.2a2 2 0 0 1-3.6 0H1zM1 11.2h2.2a2 2 0 0 1 3.6 0H15v1.6H6.8a2 2 0 0 1-3.6 0H1z" />
          </svg>
        </button>
        <button
          type="button"
          class="quiet"
          aria-label={t("comparisons.remove", { name })}
          title={isRecording ? t("compare.whileRecording") : t("comparisons.remove", { name })}
          disabled={isRecording}
          onClick={() => void removeLane(state, lane)}
        >
          ✕
        </button>
      </div>
      <div id={id} hidden={!isOpen}>
        {isOpen && law && <LaneForm law={law} state={state} comparison={comparison} />}
      </div>
    </li>
  );
}
