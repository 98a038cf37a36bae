/** The open exercise: its saved progress, its answers, its submission. */
import { computed, effect, signal } from "@preact/signals";
import {
  type Exercise,
  type ExerciseSummary,
  listCourse,
  putAnswer,
  putLaw,
  putPlace,
  readExercise,
  restoreSettings,
  type Step,
  submitExercise,
} from "../../core/api/course";
import { RefusedError } from "../../core/api/errors";
import { createWork } from "../../core/jobs/work";
import { explain, perform } from "../../core/state/actions";
import { mayCommand } from "../../core/state/control";
import { session } from "../../core/state/session";
import { place } from "../../runs/list/place";

export const exercises = signal<readonly ExerciseSummary[] | null>(null);
export const exercise = signal<Exercise | null>(null);
const { read, ...work } = createWork(explain);
export const { problem, isBusy, perform: attempt } = work;

/** The step in the address, by name or number; otherwise the last visited one, or the first. */
export const step = computed<Step | null>(() => {
  const address = place.value;
  const open = exercise.value;
  if (address.kind !== "learn" || open === null || open.name !== address.exercise) return null;
  const { parts } = open;
  const key = address.step || open.at;
  return parts.find(({ name }) => name === key) ?? parts[Number(key) - 1] ?? parts[0] ?? null;
});

/** Whether the step has settings that the student chooses. */
export const hasFreeSettings = computed(() => (step.value?.free.length ?? 0) > 0);

export async function openCourse(): Promise<void> {
  problem.value = "";
  await read(listCourse, (course) => {
    exercises.value = course.exercises;
  });
}

/** Answers may overtake each other: the one with more changes is kept. */
export function applyExercise(update: Exercise | null): void {
  const address = place.peek();
  if (update === null || (address.kind === "learn" && address.exercise !== update.name)) return;
  const shown = exercise.peek();
  if (shown?.name === update.name && update.changes < shown.changes) return;
  exercise.value = update;
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

export async function answer(of: Step, value: number | string): Promise<void> {
  const name = exercise.peek()?.name ?? "";
  applyExercise(await attempt("answer", () => putAnswer(name, of.name, value)));
}

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
