import { useEffect } from "preact/hooks";
import { isArm, settings, settingsJoint } from "../../core/state/arm";
import { lawOf } from "../../core/state/laws";
import { isLive } from "../../core/state/session";
import { t } from "../../core/text/t";
import { Problem } from "../../core/widgets/form";
import { Panel } from "../../core/widgets/panel";
import { Bandwidths } from "./bandwidths";
import { apply, discard, draft, isApplying, isChanged, isOpen } from "./draft";
import { FailButton } from "./failbutton";
import { Outcome } from "./outcome";
import { Plane } from "./plane";
import { draftPrediction, isPredicting, watchPredictions } from "./predictions";
import { stopComputing } from "./region";
import { RegionMap } from "./regionmap";
import { Responses } from "./responses";
import { watchStability } from "./stability";
import { StabilityTable } from "./stabilitytable";
import { SharedPoles, UndoButton } from "./summary";
import { describePoles } from "./words";

function close(): void {
  isOpen.value = false;
}

function Buttons() {
  const verdict = draftPrediction.value?.verdict;
  const isReady = isChanged.value && isLive.value && !isApplying.value && !isPredicting.value;
  return (
    <div class="row">
      <button
        type="button"
        class={`button is-primary ${verdict === "warn" ? "is-warned" : ""}`}
        disabled={!isReady || verdict === undefined || verdict === "refuse"}
        onClick={() => void apply()}
      >
        {verdict === "warn" && isChanged.value ? t("design.applyAnyway") : t("design.apply")}
      </button>
      <button
        type="button"
        class="button"
        disabled={!isChanged.value}
        title={t("design.discardHint")}
        onClick={discard}
      >
        {t("design.discard")}
      </button>
      <UndoButton />
    </div>
  );
}

function Roots() {
  const tried = draft.value;
  return (
    <p class="row small">
      <strong>{t("design.roots")}</strong>
      <span class="tone strong is-position">{tried && describePoles(tried.position)}</span>
      <span class="tone strong is-stiffness">{tried && describePoles(tried.stiffness)}</span>
      <span class="unit">{t("design.unit")}</span>
    </p>
  );
}

/** Pole placement: place the poles, see the predicted behaviour, then apply. */
export function DesignPanel() {
  const law = lawOf(settings.value?.configuration.law ?? "");
  return isOpen.value && law?.takes_gains !== false ? <Design /> : null;
}

function Design() {
  useEffect(watchPredictions, []);
  useEffect(watchStability, []);
  useEffect(() => stopComputing, []);
  return (
    <Panel
      title={t("design.title")}
      class="is-wide"
      onClose={close}
      aside={
        <p class="row hint" aria-hidden="true">
          <span class="tone strong is-position">✕ {t("design.legend.position")}</span>
          <span class="tone strong is-stiffness">◇ {t("design.legend.stiffness")}</span>
        </p>
      }
    >
      <div class="cells" style={{ "--cell": "340px" }}>
        <div class="stack">
          <Plane />
          <p class="hint" id="plane-hint">
            {t("design.planeHint")}
          </p>
          <Bandwidths />
        </div>
        <div class="grow column">
          {isArm.value && <p class="hint">{t("design.ofJoint", { joint: settingsJoint.value })}</p>}
          <Roots />
          <SharedPoles />
          <Outcome />
          <Problem id="design-problem" control="design.apply" />
          <FailButton />
          <Buttons />
        </div>
        <div class="halves wide divided">
          <Responses />
          <StabilityTable />
          <RegionMap />
        </div>
      </div>
    </Panel>
  );
}
