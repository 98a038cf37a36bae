/** The run of a step of an exercise: recorded to the end of the step's time, then assessed. */
import { signal } from "@preact/signals";
import { pause, reset, start, stopRecording } from "../../core/api/client";
import {
  type CriterionResult,
  checkRun,
  readExercise,
  recordStep,
  type Step,
  setUpStep,
} from "../../core/api/course";
import { readRun } from "../../core/api/runs";
import { perform } from "../../core/state/actions";
import { hasControl } from "../../core/state/control";
import { acceptState, session } from "../../core/state/session";
import { findInterruption, type RunInterruption } from "./benchstep";
import { applyExercise, attempt, exercise, problem } from "./lesson";

export const CONTROL_OF_LESSON = "lesson";
const FILE_POLL_MS = 300;
const MAX_FILE_POLLS = 60;

interface ActiveRun {
  exercise: string;
  step: string;
  run: string;
  endS: number;
  isAssessing: boolean;
}

interface StepRun {
  /** The run that is in progress, or being assessed. */
  active: ActiveRun | null;
  /**
   * The latest assessment: if it is worse than the saved one, it is shown but not saved.
   */
  assessment: { step: string; run: string; results: CriterionResult[] } | null;
  /** The run whose samples the plots show. */
  shown: { run: string; runNumber: number } | null;
  /** Of a run that was not completed, and is not assessed; the step can be started again. */
  interruption: { step: string; why: RunInterruption; timeS: number } | null;
}

export const NO_RUN: StepRun = { active: null, assessment: null, shown: null, interruption: null };
export const stepRun = signal(NO_RUN);

function update(change: Partial<StepRun>): void {
  stepRun.value = { ...stepRun.peek(), ...change };
}

const showRun = (run: string, runNumber: number) => update({ shown: { run, runNumber } });

/** Whether a step recorded this run, and reports it. */
export const isRunOfLesson = (run: string): boolean => stepRun.value.shown?.run === run;

/** The assessment next to a step: the newest of its run, otherwise the saved one. */
export const resultsOf = (shown: Step): readonly CriterionResult[] => {
  const { assessment } = stepRun.value;
  if (assessment?.step === shown.name && shown.kind === "experiment") {
    return assessment.results.filter(({ step }) => step === shown.name);
  }
  return shown.results;
};

const titleOfRun = (name: string, of: string) => `${name}/${of}`;

/** Set up the session; if nothing is to be chosen, its run starts at once. */
export async function setUp(of: Step): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  problem.value = "";
  update({ interruption: null });
  if (!(await perform(CONTROL_OF_LESSON, () => setUpStep(name, of.name)))) return;
  applyExercise(await attempt("read", () => readExercise(name)));
  if (of.free.length === 0) await run(of);
}

/** Start at t = 0 with the current settings, recorded to the end of the step's time. */
export async function run(of: Step): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  const performForLesson = (request: Parameters<typeof perform>[1]) =>
    perform(CONTROL_OF_LESSON, request);
  update({ assessment: null, interruption: null });
  if (!(await performForLesson(pause)) || !(await performForLesson(reset))) return;
  if (!(await performForLesson(() => recordStep(titleOfRun(name, of.name))))) return;
  trackRun(name, of);
  const isStarted = await performForLesson(start);
  const { active } = stepRun.peek();
  if (active === null) return;
  if (isStarted) showRun(active.run, session.peek()?.run_number ?? 0);
  else await abandonRun();
}

/** A run that does not start or continue does not count; its recording is stopped if permitted. */
async function abandonRun(): Promise<void> {
  update({ active: null });
  if (hasControl.peek()) await stopRecording().then(acceptState, () => undefined);
}

function trackRun(name: string, of: Step): void {
  const state = session.peek();
  const recording = state?.recording;
  if (state === null || recording?.state !== "recording") return;
  const endS = of.duration_s ?? 0;
  const run = recording.run_id;
  update({ active: { exercise: name, step: of.name, run, endS, isAssessing: false } });
  showRun(run, state.run_number);
}

/** After a reload: follow the recording run of this step again. */
export function resume(of: Step): void {
  const name = exercise.peek()?.name ?? "";
  const isOfStep = session.peek()?.recording?.name === titleOfRun(name, of.name);
  if (isOfStep && hasControl.peek() && stepRun.peek().active === null && of.kind === "experiment")
    trackRun(name, of);
}

/** Stop the recording when the time of the step or the run is over, and have it assessed. */
export async function follow(): Promise<void> {
  const state = session.peek();
  const { active } = stepRun.peek();
  if (state === null || active === null || active.isAssessing) return;
  const isRecorded = state.recording?.run_id === active.run;
  if (isRecorded && state.status !== "fault" && state.time_s < active.endS) {
    const why = findInterruption(state, hasControl.peek());
    if (why === null) return;
    update({ interruption: { step: active.step, why, timeS: state.time_s } });
    await abandonRun();
    return;
  }
  update({ active: { ...active, isAssessing: true } });
  if (isRecorded) {
    await perform(CONTROL_OF_LESSON, stopRecording);
    if (state.status === "running") await perform(CONTROL_OF_LESSON, pause);
  }
  if (await awaitRecord(active.run, !isRecorded)) {
    await attempt("assess", () => assess(active));
    update({ active: null });
  } else update({ active });
}

/**
 * Wait until a run is complete; false if it is still recorded. mayContinue: the page did not stop
 * it, and a state from before its start may have come late.
 */
async function awaitRecord(run: string, mayContinue: boolean): Promise<boolean> {
  for (let tries = 0; tries < MAX_FILE_POLLS; tries++) {
    if (await isFinished(run)) return true;
    const recording = session.peek()?.recording;
    const isRecording = recording?.run_id === run && recording.state === "recording";
    if (mayContinue && isRecording) return false;
    await new Promise((resolve) => setTimeout(resolve, FILE_POLL_MS));
  }
  return true;
}

async function assess({ exercise: name, step, run }: ActiveRun): Promise<void> {
  const results = await checkRun(name, step, run);
  update({ assessment: { step, run, results } });
  applyExercise(await readExercise(name));
}

/** A lost answer has no information: request again. */
const isFinished = (run: string): Promise<boolean> =>
  readRun(run).then(
    ({ state }) => state !== "recording",
    () => false,
  );
