import schema from "schema:TuningRequest";
import { useEffect, useState } from "preact/hooks";
import { tunedFileOf } from "../../core/api/jobs";
import { sessionName } from "../../core/api/request";
import { RequestFields } from "../../core/forms/fields";
import { useRequest } from "../../core/forms/request";
import { titleOf, usableLaws } from "../../core/state/laws";
import { isLive, session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { ErrorLine, Problem } from "../../core/widgets/form";
import { Panel } from "../../core/widgets/panel";
import { CostCurve } from "./costcurve";
import { ResultTable, ValueTable } from "./tables";
import {
  applyBest,
  CONTROL,
  candidates,
  findNewest,
  isBusy,
  isOpen,
  isTuning,
  problem,
  start,
  stop,
  tuning,
} from "./tuning";

function close(): void {
  isOpen.value = false;
}

/** Law, budget, start and stop. */
function Choice() {
  const { law = "" } = session.value?.configuration ?? {};
  const choices = { law: usableLaws.value };
  const form = useRequest(schema, choices, { law, session: sessionName });
  return (
    <form
      class="row small"
      onSubmit={(event) => {
        event.preventDefault();
        void form.attempt(start);
      }}
    >
      <fieldset class="row" disabled={isTuning.value}>
        <RequestFields form={form} schema={schema} replace={{ held: null, session: null }} isRow />
      </fieldset>
      {isTuning.value ? (
        <button
          type="button"
          class="button"
          title={t("tuning.stopHint")}
          onClick={() => void stop()}
        >
          {t("tuning.stop")}
        </button>
      ) : (
        <button
          type="submit"
          class="button is-primary"
          disabled={form.body.law === "" || isBusy.value !== ""}
        >
          {t("tuning.start")}
        </button>
      )}
    </form>
  );
}

function TuningResult() {
  const state = tuning.value;
  const [used, setUsed] = useState("");
  if (state === null) return null;
  const { present, best } = state;
  const isBetter = present !== null && best !== null && best.number > 0;
  const mark = `${state.id} ${best?.number}`;
  return (
    <>
      <div>
        <p class="hint" role="status">
          {t("tuning.progress", {
            law: titleOf(state.law),
            tried: Math.max(0, state.tried - 1),
            budget: state.budget,
          })}
          . {t(`tuning.status.${state.status}`)}
          {state.problem && ` ${state.problem}`}
        </p>
        {isTuning.value && (
          <progress
            max={state.budget + 1}
            value={state.tried}
            aria-label={t("tuning.progress", {
              law: titleOf(state.law),
              tried: Math.max(0, state.tried - 1),
              budget: state.budget,
            })}
          />
        )}
      </div>
      {present === null || best === null ? (
        isTuning.value && <p class="hint">{t("tuning.first")}</p>
      ) : (
        <div class="halves">
          <CostCurve candidates={candidates.value} budget={state.budget} />
          <ValueTable tuning={state} present={present} best={best} />
          <ResultTable tuning={state} present={present} best={best} />
        </div>
      )}
      <div class="row">
        <button
          type="button"
          class="button is-primary"
          disabled={!isBetter || !isLive.value}
          title={t("tuning.useHint")}
          onClick={() => void applyBest().then((isDone) => setUsed(isDone ? mark : ""))}
        >
          {t("tuning.use")}
        </button>
        {!isTuning.value && best !== null && (
          <a class="button" href={tunedFileOf(state.id)} download title={t("tuning.saveHint")}>
            {t("tuning.save")}
          </a>
        )}
        <Problem control={CONTROL} />
        <span class="hint" role="status">
          {used === mark && t("tuning.used")}
          {used === mark &&
            session.value?.configuration.law !== state.law &&
            ` ${t("tuning.otherLaw", { law: titleOf(state.law) })}`}
          {used !== mark && !isTuning.value && best !== null && !isBetter && t("tuning.notBetter")}
        </span>
      </div>
    </>
  );
}

/** Tune a law's parameters while the lab runs. */
export function TunePanel() {
  useEffect(() => void findNewest(), []);
  return (
    <Panel title={t("tuning.title")} class="is-wide" onClose={close}>
      <div class="stack">
        <p class="hint">{t("tuning.about")}</p>
        <Choice />
        <ErrorLine>{problem.value}</ErrorLine>
        <TuningResult />
        <p class="hint">{t("tuning.cost")}</p>
      </div>
    </Panel>
  );
}
