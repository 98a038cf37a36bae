/** The course: exercises, progress, measured runs and grades. */

import { call } from "./operations";
import { API, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";

type Schemas = components["schemas"];

export type ExerciseSummary = Schemas["ExerciseSummary"];
export type Exercise = Schemas["ExerciseState"];
export type Step = Schemas["StepState"];
export type CriterionResult = Schemas["CriterionResult"];

export const listCourse = () => call("get", "/course", {});
export const readExercise = (exercise: string) =>
  call("get", "/course/{exercise}", { path: { exercise } });
export const putPlace = (exercise: string, step: string) =>
  call("put", "/course/{exercise}/place", { path: { exercise }, body: { step } });
export const putAnswer = (exercise: string, step: string, answer: number | string) =>
  call("put", "/course/{exercise}/steps/{step}/answer", {
    path: { exercise, step },
    body: { answer },
  });
export const checkRun = (exercise: string, step: string, run: string) =>
  call(
    "post",
    "/course/{exercise}/steps/{step}/check",
    { path: { exercise, step }, body: { run_id: run } },
    WORK_TIMEOUT_MS,
  );
export const putLaw = (exercise: string, text: string) =>
  call("put", "/course/{exercise}/law", { path: { exercise }, body: { text } }, WORK_TIMEOUT_MS);
export const submitExercise = (exercise: string, student: string) =>
  call(
    "post",
    "/course/{exercise}/submission",
    { path: { exercise }, body: { student } },
    WORK_TIMEOUT_MS,
  );
/** Set up this page's session for an experiment, at t = 0 and paused. */
export const setUpStep = (exercise: string, step: string) =>
  call("post", "/sessions/{session}/experiment", { body: { from: "exercise", exercise, step } });
/** Restore the settings from before the exercise, at t = 0. */
export const restoreSettings = () =>
  call("post", "/sessions/{session}/experiment", { body: { from: "before_exercise" } });
/** The run is named after its exercise and step. */
export const recordStep = (name: string) =>
  call("post", "/sessions/{session}/recording", {
    body: { name, tags: ["course"], notes: "" },
  });
// Grades: of the whole class for its instructor, and the student's own.

export type Grades = Schemas["GradesState"];
export type Student = Schemas["StudentState"];
export type Submission = Schemas["GradedSubmissionState"];
export type Grade = NonNullable<Submission["grade"]>;

/** The first request tests whether this machine can isolate a law. */
export const readGrades = () => call("get", "/grades", {}, WORK_TIMEOUT_MS) as Promise<Grades>;
export const gradeClass = (again: boolean) => call("post", "/grades", { body: { again } });
export const readOwnGrades = async () =>
  (await readGrades()).students.flatMap(({ submissions }) => submissions);

const addressOf = (format: string): string => new URL(`grades?format=${format}`, API).href;
export const GRADES_CSV = addressOf("csv");
/** The whole class for its instructor; for a student the student's own grades. */
export const GRADES_PAGE = addressOf("html");
export const pageOfStudent = (person: string): string =>
  `${GRADES_PAGE}&person=${encodeURIComponent(person)}`;
