/** The open exercise: its saved progress, and its actions. */
import { computed, effect, signal } from "@preact/signals";
import { pause, reset, start, stopRecording } from "../../core/api/client";
import {
  type CriterionResult,
  checkRun,
  type Exercise,
  type ExerciseSummary,
  submit as giveIn,
  listCourse,
  openOwnSession,
  putAnswer,
  putLaw,
  putPlace,
  readExercise,
  recordStep,
  restoreSettings,
  type Step,
  setUpStep,
} from "../../core/api/course";
import { RefusedError } from "../../core/api/errors";
import { readRun } from "../../core/api/runs";
import { reading } from "../../core/jobs/poll";
import { explain, perform, showErrorIn } from "../../core/state/actions";
import { hasControl, mayCommand } from "../../core/state/control";
import { acceptState, session } from "../../core/state/session";
import { place, writePlace } from "../../runs/list/place";
import { type Cut, findCut } from "./benchstep";

export const CONTROL_OF_LESSON = "lesson";
const FILE_MS = 300;
const FILE_PATIENCE = 60;

export const exercises = signal<readonly ExerciseSummary[] | null>(null);
export const exercise = signal<Exercise | null>(null);
/** Why something of the course was not done; the next wish takes its place. */
export const problem = signal("");
export const isBusy = signal(false);

/** The run of a step that is under way, or being judged. */
interface Trial {
  exercise: string;
  step: string;
  run: string;
  endS: number;
  isJudged: boolean;
}
export const trial = signal<Trial | null>(null);
/** What was judged last, with its run: worse than what is kept, it is shown and not kept. */
export const judged = signal<{ step: string; run: string; results: CriterionResult[] } | null>(
  null,
);
/** The run whose samples the plots show. */
export const shownRun = signal<{ run: string; runNumber: number } | null>(null);
/** A run that was not completed, and is not judged; the step can be started again. */
export const cut = signal<{ step: string; why: Cut; timeS: number } | null>(null);
/** A step recorded this run, and tells of it. */
export const isOfLesson = (run: string): boolean => shownRun.value?.run === run;

/** The step that the address names or numbers, or where one was last, or the first. */
export const step = computed<Step | null>(() => {
  const at = place.value;
  const found = exercise.value;
  if (at.kind !== "learn" || found === null || found.name !== at.exercise) return null;
  const wanted = at.step || found.at;
  const { parts } = found;
  return parts.find(({ name }) => name === wanted) ?? parts[Number(wanted) - 1] ?? parts[0] ?? null;
});

/** Whether the step leaves anything to be set by hand. */
export const hasFreeSettings = computed(() => (step.value?.free.length ?? 0) > 0);

/** What is shown next to a step: the newest assessment of its run, else the saved one. */
export const resultsOf = (one: Step): readonly CriterionResult[] => {
  const newest = judged.value;
  if (newest?.step === one.name && one.kind === "experiment") {
    return newest.results.filter(({ step: of }) => of === one.name);
  }
  return one.results;
};

async function attempt<T>(wish: () => Promise<T>): Promise<T | null> {
  problem.value = "";
  isBusy.value = true;
  try {
    return await wish();
  } catch (error) {
    problem.value = explain(error);
    return null;
  } finally {
    isBusy.value = false;
  }
}

const read = reading(showErrorIn(problem));

export async function openCourse(): Promise<void> {
  problem.value = "";
  await read(listCourse, (found) => {
    exercises.value = found.exercises;
  });
}

/** Answers may overtake each other: the one that knows of more changes stays. */
function show(found: Exercise | null): void {
  const at = place.peek();
  if (found === null || (at.kind === "learn" && at.exercise !== found.name)) return;
  const shown = exercise.peek();
  if (shown?.name === found.name && found.changes < shown.changes) return;
  exercise.value = found;
}

export async function openExercise(name: string): Promise<void> {
  if (exercise.peek()?.name !== name) exercise.value = null;
  problem.value = "";
  await read(() => readExercise(name), show);
}

/** The server knows where one is, for another browser; who only watches keeps no place. */
export async function visit(name: string, at: string): Promise<void> {
  try {
    show(await putPlace(name, at));
  } catch (error) {
    if (!(error instanceof RefusedError)) problem.value = explain(error);
  }
}

export async function answer(of: Step, given: number | string): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  show(await attempt(() => putAnswer(name, of.name, given)));
}

const titleOfRun = (name: string, of: string) => `${name}/${of}`;

/** Sets the session up; where nothing is to be chosen its run begins at once. */
export async function setUp(of: Step): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  problem.value = "";
  cut.value = null;
  if (!(await perform(CONTROL_OF_LESSON, () => setUpStep(name, of.name)))) return;
  show(await attempt(() => readExercise(name)));
  if (of.free.length === 0) await run(of);
}

/** From t = 0 with what is set, recorded to the end of the step's time. */
export async function run(of: Step): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  const doNow = (wish: Parameters<typeof perform>[1]) => perform(CONTROL_OF_LESSON, wish);
  judged.value = cut.value = null;
  if (!(await doNow(pause)) || !(await doNow(reset))) return;
  if (!(await doNow(() => recordStep(titleOfRun(name, of.name))))) return;
  take(name, of);
  const isBegun = await doNow(start);
  const now = trial.peek();
  if (now === null) return;
  if (isBegun) shownRun.value = { run: now.run, runNumber: session.peek()?.run_number ?? 0 };
  else await giveUp();
}

/** A run that does not begin, or not continue, is no trial; its recording ends where one may end it. */
async function giveUp(): Promise<void> {
  trial.value = null;
  if (hasControl.peek()) await stopRecording().then(acceptState, () => undefined);
}

function take(name: string, of: Step): void {
  const state = session.peek();
  const recording = state?.recording;
  if (state === null || recording?.state !== "recording") return;
  trial.value = {
    exercise: name,
    step: of.name,
    run: recording.run_id,
    endS: of.duration_s ?? 0,
    isJudged: false,
  };
  shownRun.value = { run: recording.run_id, runNumber: state.run_number };
}

/** After a reload: the run of this step that is being recorded is followed again. */
export function resume(of: Step): void {
  const name = exercise.peek()?.name ?? "";
  const isOfStep = session.peek()?.recording?.name === titleOfRun(name, of.name);
  if (isOfStep && hasControl.peek() && trial.peek() === null && of.kind === "experiment")
    take(name, of);
}

/** Ends the recording when the time of the step is over, or the run, and has it judged. */
export async function follow(): Promise<void> {
  const state = session.peek();
  const now = trial.peek();
  if (state === null || now === null || now.isJudged) return;
  const isRecorded = state.recording?.run_id === now.run;
  if (isRecorded && state.status !== "fault" && state.time_s < now.endS) {
    const why = findCut(state, hasControl.peek());
    if (why === null) return;
    cut.value = { step: now.step, why, timeS: state.time_s };
    await giveUp();
    return;
  }
  trial.value = { ...now, isJudged: true };
  if (isRecorded) {
    await perform(CONTROL_OF_LESSON, stopRecording);
    if (state.status === "running") await perform(CONTROL_OF_LESSON, pause);
  }
  await attempt(() => judge(now));
  trial.value = null;
}

async function judge(now: Trial): Promise<void> {
  for (let tries = 0; tries < FILE_PATIENCE; tries++) {
    if (await isFinished(now.run)) break;
    await new Promise((resolve) => setTimeout(resolve, FILE_MS));
  }
  const results = await checkRun(now.exercise, now.step, now.run);
  judged.value = { step: now.step, run: now.run, results };
  show(await readExercise(now.exercise));
}

/** An answer that does not come says nothing: asked again. */
const isFinished = (run: string): Promise<boolean> =>
  readRun(run).then(
    ({ state }) => state !== "recording",
    () => false,
  );

/** Tried by the server, and kept there until it is submitted. */
export async function tryLaw(law: string): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  show(await attempt(() => putLaw(name, law)));
}

export async function submit(student: string): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  const judgement = await attempt(() => giveIn(name, student));
  if (judgement === null) return;
  show(await attempt(() => readExercise(name)));
}

export const restore = (): Promise<boolean> => perform("session", restoreSettings);

/** Where the lab is entered from another place, an exercise takes its settings back. */
export function watchLeaving(): void {
  let before = place.peek().kind;
  effect(() => {
    const { kind } = place.value;
    const isEntered = kind === "lab" && before !== "lab";
    before = kind;
    const state = session.peek();
    const isOver = state !== null && state.exercise !== null && state.recording === null;
    if (isEntered && isOver && mayCommand.peek()) void restore();
  });
}

/** Continues in a session that no other user commands; the page is reloaded with it. */
export async function workApart(): Promise<void> {
  const name = await attempt(openOwnSession);
  if (name === null) return;
  const query = new URLSearchParams(location.search);
  query.set("session", name);
  location.search = writePlace(place.peek(), `?${query}`);
}

/** What a step's task is given. onDone: called when the result is shown in place of the task. */
export interface Task {
  of: Step;
  exercise: Exercise;
  onDone: () => void;
}
