/** An experiment step: set up a session, run it, and assess its record. */

import { useEffect } from "preact/hooks";
import type { Step } from "../../core/api/course";
import { mayCommand } from "../../core/state/control";
import { bench } from "../../core/state/plant";
import { session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { formatFixed } from "../../core/units";
import { Banner } from "../../core/widgets/banner";
import { Problem } from "../../core/widgets/form";
import { isSwitchHeld } from "../../hardware/hold";
import { PlaceLink } from "../../runs/list/place";
import { criteriaOf, dueManualLoad, isOfSession, isPossibleOn, readinessOf } from "./benchstep";
import { isBusy, restoreLab, type TaskProps } from "./lesson";
import { CutOff, Obstacle } from "./obstacle";
import { Results } from "./results";
import { CONTROL_OF_LESSON, follow, resultsOf, resume, run, setUp, stepRun } from "./steprun";

/**
 * In the lab: shows that the settings are those of an exercise, with a button for the earlier ones.
 */
export function ExerciseBanner({ exercise }: { exercise: string }) {
  return (
    <Banner look="is-accent" words={t("lesson.hasSettings")}>
      <PlaceLink to={{ kind: "learn", exercise, step: "" }}>{t("lesson.resume")}</PlaceLink>
      <button
        type="button"
        class="button"
        disabled={!mayCommand.value}
        onClick={() => void restoreLab()}
      >
        {t("lesson.restore")}
      </button>
    </Banner>
  );
}

/** Time at which the operator adds or removes a load; an emulator does it automatically. */
function ManualLoads({ of }: { of: Step }) {
  const now = bench.value;
  const state = session.value;
  if (now === null || of.bench === null || of.bench.manual_loads.length === 0) return null;
  if (now.emulated) return <p class="hint">{t("lesson.loadOfEmulator")}</p>;
  const { manual_load: what, manual_loads: loads } = of.bench;
  if (stepRun.value.active?.step !== of.name) {
    return (
      <p class="hint">
        {t("lesson.manualLoads", {
          what,
          times: loads
            .map(({ time_s: time, is_on: isOn }) =>
              isOn ? t("lesson.loadOn", { time }) : t("lesson.loadOff", { time }),
            )
            .join(", "),
        })}
      </p>
    );
  }
  const timeS = state?.time_s ?? 0;
  const due = dueManualLoad(of, timeS);
  if (due === null) return null;
  const isDue = timeS >= due.time_s;
  return (
    <p class={`note is-accent ${isDue ? "strong" : ""}`} aria-live="assertive">
      {isDue
        ? due.is_on
          ? t("lesson.manualLoadNow", { what })
          : t("lesson.manualRemovalNow")
        : due.is_on
          ? t("lesson.manualLoadAt", { time: due.time_s, what })
          : t("lesson.manualRemovalAt", { time: due.time_s })}
    </p>
  );
}

/** Until the run of a step has ended and is assessed. */
function Running({ of }: { of: Step }) {
  const now = stepRun.value.active;
  if (now === null || now.step !== of.name) return null;
  const state = session.value;
  return (
    <p class="note is-accent" role="status">
      {now.isAssessing
        ? t("lesson.judging")
        : t("lesson.seconds", {
            now: formatFixed(Math.min(state?.time_s ?? 0, now.endS), 1),
            end: now.endS,
          })}
    </p>
  );
}

export function Trial({ of, exercise, onDone }: TaskProps) {
  const state = session.value;
  useEffect(() => resume(of), [of, state?.recording?.run_id]);
  useEffect(() => {
    void follow();
  }, [state]);
  const missing = exercise.parts.find(
    (part) => part.kind === "predict" && part.judged_by === of.name && part.answer === null,
  );
  const { active, assessment } = stepRun.value;
  const isRunning = active !== null;
  useEffect(() => {
    if (assessment?.step === of.name) onDone();
  }, [assessment]);
  const isOff =
    missing !== undefined ||
    isRunning ||
    isBusy.value !== "" ||
    !mayCommand.value ||
    !isPossibleOn(of, bench.value) ||
    !isOfSession(of, state) ||
    exercise.submitted_at !== null;
  const { canConfigure: mayBeSet, canRun: mayRun } = readinessOf(bench.value, isSwitchHeld.value);
  const criteria = criteriaOf(of, bench.value);
  const isFree = of.free.length > 0;
  const predictions = exercise.parts.filter(
    (part) => part.kind === "predict" && part.judged_by === of.name,
  );
  const runShown = assessment?.step === of.name ? assessment.run : of.run_id;
  return (
    <>
      {criteria.length > 0 && (
        <>
          <h4>{t("lesson.asked")}</h4>
          <ul class="bullets small">
            {criteria.map((criterion) => (
              <li key={criterion}>{criterion}</li>
            ))}
          </ul>
        </>
      )}
      {isFree && (
        <p class="hint">
          {t("lesson.free", {
            what: of.free
              .map((name) => t(`lesson.freeNames.${name}`, { defaultValue: name }))
              .join(", "),
          })}
        </p>
      )}
      {missing !== undefined && (
        <p class="note">
          <PlaceLink to={{ kind: "learn", exercise: exercise.name, step: missing.name }}>
            {t("lesson.predictFirst", { step: missing.title })}
          </PlaceLink>
        </p>
      )}
      <CutOff of={of} />
      <Obstacle of={of} />
      <ManualLoads of={of} />
      <p class="row">
        <button
          type="button"
          class={isFree && of.begun ? "button" : "button is-primary"}
          title={t("lesson.setUpHint")}
          disabled={isOff || !(isFree ? mayBeSet : mayRun)}
          onClick={() => void setUp(of)}
        >
          {isFree ? t("lesson.setUp") : of.begun ? t("lesson.again") : t("lesson.setUpAndRun")}
        </button>
        {isFree && (
          <button
            type="button"
            class="button is-primary"
            title={t("lesson.runHint")}
            disabled={isOff || !mayRun || !of.begun}
            onClick={() => void run(of)}
          >
            {t("lesson.run")}
          </button>
        )}
      </p>
      <Problem control={CONTROL_OF_LESSON} />
      <Running of={of} />
      {!isRunning && (
        <>
          <Results of={of} results={resultsOf(of)} run={runShown} />
          {predictions.map((prediction) => (
            <Results
              key={prediction.name}
              of={prediction}
              results={prediction.results}
              run={of.run_id}
            />
          ))}
        </>
      )}
    </>
  );
}
