/** The open exercise: its saved progress, and its actions. */
import { computed, effect, signal } from "@preact/signals";
import { pause, reset, start, stopRecording } from "../../core/api/client";
import {
  type CriterionResult,
  checkRun,
  type Exercise,
  type ExerciseSummary,
  listCourse,
  putAnswer,
  putLaw,
  putPlace,
  readExercise,
  recordStep,
  restoreSettings,
  type Step,
  setUpStep,
  submitExercise,
} from "../../core/api/course";
import { RefusedError } from "../../core/api/errors";
import { readRun } from "../../core/api/runs";
import { createWork } from "../../core/jobs/work";
import { explain, perform } from "../../core/state/actions";
import { hasControl, mayCommand } from "../../core/state/control";
import { acceptState, session } from "../../core/state/session";
import { place } from "../../runs/list/place";
import { findInterruption, type RunInterruption } from "./benchstep";

export const CONTROL_OF_LESSON = "lesson";
const FILE_POLL_MS = 300;
const MAX_FILE_POLLS = 60;

export const exercises = signal<readonly ExerciseSummary[] | null>(null);
export const exercise = signal<Exercise | null>(null);
const { read, perform: attempt, ...work } = createWork(explain);
export const { problem, isBusy } = work;

/** The run of a step that is in progress, or being assessed. */
interface StepRun {
  exercise: string;
  step: string;
  run: string;
  endS: number;
  isAssessing: boolean;
}
export const activeRun = signal<StepRun | null>(null);
/**
 * The latest assessment, with its run: if it is worse than the saved one, it is shown but not
 * saved.
 */
export const lastAssessment = signal<{
  step: string;
  run: string;
  results: CriterionResult[];
} | null>(null);
/** The run whose samples the plots show. */
export const shownRun = signal<{ run: string; runNumber: number } | null>(null);
/** A run that was not completed, and is not assessed; the step can be started again. */
export const interruption = signal<{ step: string; why: RunInterruption; timeS: number } | null>(
  null,
);
/** Whether a step recorded this run, and reports it. */
export const isRunOfLesson = (run: string): boolean => shownRun.value?.run === run;

/** The step in the address, by name or number; otherwise the last visited one, or the first. */
export const step = computed<Step | null>(() => {
  const at = place.value;
  const found = exercise.value;
  if (at.kind !== "learn" || found === null || found.name !== at.exercise) return null;
  const wanted = at.step || found.at;
  const { parts } = found;
  return parts.find(({ name }) => name === wanted) ?? parts[Number(wanted) - 1] ?? parts[0] ?? null;
});

/** Whether the step has settings that the student chooses. */
export const hasFreeSettings = computed(() => (step.value?.free.length ?? 0) > 0);

/** The assessment next to a step: the newest of its run, otherwise the saved one. */
export const resultsOf = (one: Step): readonly CriterionResult[] => {
  const newest = lastAssessment.value;
  if (newest?.step === one.name && one.kind === "experiment") {
    return newest.results.filter(({ step: of }) => of === one.name);
  }
  return one.results;
};

export async function openCourse(): Promise<void> {
  problem.value = "";
  await read(listCourse, (found) => {
    exercises.value = found.exercises;
  });
}

/** Answers may overtake each other: the one with more changes is kept. */
function applyExercise(found: Exercise | null): void {
  const at = place.peek();
  if (found === null || (at.kind === "learn" && at.exercise !== found.name)) return;
  const shown = exercise.peek();
  if (shown?.name === found.name && found.changes < shown.changes) return;
  exercise.value = found;
}

export async function openExercise(name: string): Promise<void> {
  if (exercise.peek()?.name !== name) exercise.value = null;
  problem.value = "";
  await read(() => readExercise(name), applyExercise);
}

/**
 * The server stores the current step, for another browser; a viewer without control stores none.
 */
export async function storePlace(name: string, at: string): Promise<void> {
  try {
    applyExercise(await putPlace(name, at));
  } catch (error) {
    if (!(error instanceof RefusedError)) problem.value = explain(error);
  }
}

export async function answer(of: Step, given: number | string): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  applyExercise(await attempt("answer", () => putAnswer(name, of.name, given)));
}

const titleOfRun = (name: string, of: string) => `${name}/${of}`;

/** Set up the session; if nothing is to be chosen, its run starts at once. */
export async function setUp(of: Step): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  problem.value = "";
  interruption.value = null;
  if (!(await perform(CONTROL_OF_LESSON, () => setUpStep(name, of.name)))) return;
  applyExercise(await attempt("read", () => readExercise(name)));
  if (of.free.length === 0) await run(of);
}

/** Start at t = 0 with the current settings, recorded to the end of the step's time. */
export async function run(of: Step): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  const performForLesson = (request: Parameters<typeof perform>[1]) =>
    perform(CONTROL_OF_LESSON, request);
  lastAssessment.value = interruption.value = null;
  if (!(await performForLesson(pause)) || !(await performForLesson(reset))) return;
  if (!(await performForLesson(() => recordStep(titleOfRun(name, of.name))))) return;
  trackRun(name, of);
  const isStarted = await performForLesson(start);
  const now = activeRun.peek();
  if (now === null) return;
  if (isStarted) shownRun.value = { run: now.run, runNumber: session.peek()?.run_number ?? 0 };
  else await abandonRun();
}

/** A run that does not start or continue does not count; its recording is stopped if permitted. */
async function abandonRun(): Promise<void> {
  activeRun.value = null;
  if (hasControl.peek()) await stopRecording().then(acceptState, () => undefined);
}

function trackRun(name: string, of: Step): void {
  const state = session.peek();
  const recording = state?.recording;
  if (state === null || recording?.state !== "recording") return;
  activeRun.value = {
    exercise: name,
    step: of.name,
    run: recording.run_id,
    endS: of.duration_s ?? 0,
    isAssessing: false,
  };
  shownRun.value = { run: recording.run_id, runNumber: state.run_number };
}

/** After a reload: follow the recording run of this step again. */
export function resume(of: Step): void {
  const name = exercise.peek()?.name ?? "";
  const isOfStep = session.peek()?.recording?.name === titleOfRun(name, of.name);
  if (isOfStep && hasControl.peek() && activeRun.peek() === null && of.kind === "experiment")
    trackRun(name, of);
}

/** Stop the recording when the time of the step or the run is over, and have it assessed. */
export async function follow(): Promise<void> {
  const state = session.peek();
  const now = activeRun.peek();
  if (state === null || now === null || now.isAssessing) return;
  const isRecorded = state.recording?.run_id === now.run;
  if (isRecorded && state.status !== "fault" && state.time_s < now.endS) {
    const why = findInterruption(state, hasControl.peek());
    if (why === null) return;
    interruption.value = { step: now.step, why, timeS: state.time_s };
    await abandonRun();
    return;
  }
  activeRun.value = { ...now, isAssessing: true };
  if (isRecorded) {
    await perform(CONTROL_OF_LESSON, stopRecording);
    if (state.status === "running") await perform(CONTROL_OF_LESSON, pause);
  }
  if (await awaitRecord(now.run, !isRecorded)) {
    await attempt("assess", () => assess(now));
    activeRun.value = null;
  } else activeRun.value = now;
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

async function assess(now: StepRun): Promise<void> {
  const results = await checkRun(now.exercise, now.step, now.run);
  lastAssessment.value = { step: now.step, run: now.run, results };
  applyExercise(await readExercise(now.exercise));
}

/** A lost answer has no information: request again. */
const isFinished = (run: string): Promise<boolean> =>
  readRun(run).then(
    ({ state }) => state !== "recording",
    () => false,
  );

/** Tried by the server, and stored there until it is submitted. */
export async function tryLaw(law: string): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  applyExercise(await attempt("law", () => putLaw(name, law)));
}

export async function submit(student: string): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  const judgement = await attempt("submit", () => submitExercise(name, student));
  if (judgement === null) return;
  applyExercise(await attempt("read", () => readExercise(name)));
}

export const restoreLab = (): Promise<boolean> => perform("session", restoreSettings);

/** When the lab is opened from another page, an exercise restores its settings. */
export function watchLeaving(): void {
  let before = place.peek().kind;
  effect(() => {
    const { kind } = place.value;
    const isEntered = kind === "lab" && before !== "lab";
    before = kind;
    const state = session.peek();
    const isExerciseOver = state !== null && state.exercise !== null && state.recording === null;
    if (isEntered && isExerciseOver && mayCommand.peek()) void restoreLab();
  });
}

/** Properties of a step's task. onDone: called when the result replaces the task. */
export interface TaskProps {
  of: Step;
  exercise: Exercise;
  onDone: () => void;
}
