/** An experiment step: set up a session, run it, and assess its record. */
import { useEffect } from "preact/hooks";
import type { Step } from "../../core/api/course";
import { mayCommand } from "../../core/state/control";
import { bench, session } from "../../core/state/session";
import { text } from "../../core/text/en";
import { Banner } from "../../core/widgets/banner";
import { Problem } from "../../core/widgets/form";
import { isSwitchHeld } from "../../hardware/hold";
import { PlaceLink } from "../../runs/list/place";
import { criteriaOf, dueManualLoad, isOfSession, isPossibleOn, readinessOf } from "./benchstep";
import { isBusy, restoreLab, type TaskProps } from "./lesson";
import { CutOff, Obstacle } from "./obstacle";
import { Results } from "./results";
import { CONTROL_OF_LESSON, follow, resultsOf, resume, run, setUp, stepRun } from "./steprun";

const words = text.lesson;

/**
 * In the lab: shows that the settings are those of an exercise, with a button for the earlier ones.
 */
export function ExerciseBanner({ exercise }: { exercise: string }) {
  return (
    <Banner look="is-news" words={words.hasSettings}>
      <PlaceLink to={{ kind: "learn", exercise, step: "" }}>{words.resume}</PlaceLink>
      <button
        type="button"
        class="button"
        disabled={!mayCommand.value}
        onClick={() => void restoreLab()}
      >
        {words.restore}
      </button>
    </Banner>
  );
}

/** Time at which the operator adds or removes a load; an emulator does it automatically. */
function ManualLoads({ of }: { of: Step }) {
  const now = bench.value;
  const state = session.value;
  if (now === null || of.bench === null || of.bench.manual_loads.length === 0) return null;
  if (now.emulated) return <p class="hint">{words.loadOfEmulator}</p>;
  const { manual_load: what, manual_loads: loads } = of.bench;
  if (stepRun.value.active?.step !== of.name) {
    return <p class="hint">{words.manualLoads(what, loads)}</p>;
  }
  const timeS = state?.time_s ?? 0;
  const due = dueManualLoad(of, timeS);
  if (due === null) return null;
  const isDue = timeS >= due.time_s;
  return (
    <p class={`note is-accent ${isDue ? "strong" : ""}`} aria-live="assertive">
      {isDue
        ? words.manualLoadNow(what, due.is_on)
        : words.manualLoadAt(what, due.is_on, due.time_s)}
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
      {now.isAssessing ? words.judging : words.seconds(state?.time_s ?? 0, now.endS)}
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
          <h4>{words.asked}</h4>
          <ul class="bullets small">
            {criteria.map((criterion) => (
              <li key={criterion}>{criterion}</li>
            ))}
          </ul>
        </>
      )}
      {isFree && (
        <p class="hint">
          {words.free(of.free.map((name) => words.freeNames[name] ?? name).join(", "))}
        </p>
      )}
      {missing !== undefined && (
        <p class="note">
          <PlaceLink to={{ kind: "learn", exercise: exercise.name, step: missing.name }}>
            {words.predictFirst(missing.title)}
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
          title={words.setUpHint}
          disabled={isOff || !(isFree ? mayBeSet : mayRun)}
          onClick={() => void setUp(of)}
        >
          {isFree ? words.setUp : of.begun ? words.again : words.setUpAndRun}
        </button>
        {isFree && (
          <button
            type="button"
            class="button is-primary"
            title={words.runHint}
            disabled={isOff || !mayRun || !of.begun}
            onClick={() => void run(of)}
          >
            {words.run}
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
