import type { SessionState } from "../../core/api/types";
import { comparisonLanes } from "../../core/state/lanes";
import { lawOf } from "../../core/state/laws";
import { isLive, session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { Problem } from "../../core/widgets/form";
import { PanelButton } from "../../core/widgets/panel";
import { designInUse, discard, isOpen } from "./draft";
import { steps, undo } from "./history";
import { describePoles } from "./words";

export function UndoButton() {
  const count = steps.value.length;
  return (
    <button
      type="button"
      class="button"
      disabled={count === 0 || !isLive.value}
      aria-label={count === 0 ? t("design.undo") : t("design.undoSteps", { count })}
      title={t("design.undoHint")}
      onClick={() => {
        discard();
        void undo();
      }}
    >
      <svg viewBox="0 0 16 16" aria-hidden="true">
        <path d="M6 2.2v3h4.2a4.4 4.4 0 0 1 0 8.8H4v-2h6.2a2.4 2.4 0 0 0 0-4.8H6v3L1.4 6.2z" />
      </svg>
      {t("design.undo")}
      {count > 0 && <span class="tag tiny"> {count}</span>}
    </button>
  );
}

/** The button alone, with the reason of a rejected undo. */
export function Undo() {
  return (
    <div class="row">
      <UndoButton />
      <Problem control="design.undo" />
    </div>
  );
}

/** The comparisons without their own gains. */
const sharedWith = (state: SessionState): string[] =>
  comparisonLanes(state)
    .filter(({ controller: { law, gains } }) => !gains && lawOf(law)?.takes_gains)
    .map(({ name }) => name);

/** The comparisons that use the placed poles. */
export function SharedPoles() {
  const state = session.value;
  const shared = state === null ? [] : sharedWith(state);
  return shared.length > 0 ? (
    <p class="hint">{t("design.shared", { names: shared.join(", ") })}</p>
  ) : null;
}

/** The poles in use, and a button to change them, which predicts the behaviour of one joint. */
export function DesignSummary() {
  const now = designInUse.value;
  if (now === null) return null;
  return (
    <>
      <dl class="facts">
        {(["position", "stiffness"] as const).map((group) => (
          <div key={group}>
            <dt>{t("design.summary", { group: t(`design.${group}`) })}</dt>
            <dd>
              {describePoles(now[group])} <span class="unit">{t("design.unit")}</span>
            </dd>
          </div>
        ))}
      </dl>
      <SharedPoles />
      <div class="row">
        <PanelButton isOpen={isOpen} hint={t("design.openHint")}>
          <svg viewBox="0 0 16 16" aria-hidden="true">
            <path d="M11 0h1.6v16H11zM0 7.2h16v1.6H0zM3 1.8l1.4 1.4L5.8 1.8l1 1-1.4 1.4 1.4 1.4-1 1-1.4-1.4L3 6.6l-1-1 1.4-1.4L2 2.8zM3 9.8l1.4 1.4 1.4-1.4 1 1-1.4 1.4 1.4 1.4-1 1-1.4-1.4L3 14.6l-1-1 1.4-1.4L2 10.8z" />
          </svg>
          {t("design.open")}
        </PanelButton>
        <UndoButton />
      </div>
      <Problem control="design.undo" />
    </>
  );
}
