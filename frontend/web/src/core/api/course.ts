/** The course: exercises, progress, measured runs and grades. */

import type { Job } from "./jobs";
import { API, request, sessionName, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";
import type { SessionState } from "./types";

type Schemas = components["schemas"];

export type ExerciseSummary = Schemas["ExerciseSummary"];
export type Exercise = Schemas["ExerciseState"];
export type Step = Schemas["StepState"];
export type CriterionResult = Schemas["CriterionResult"];
type Judgement = Schemas["Judgement"];

const pathOf = (exercise: string, rest = "") => `course/${encodeURIComponent(exercise)}${rest}`;
const stepOf = (exercise: string, step: string, rest: string) =>
  pathOf(exercise, `/steps/${encodeURIComponent(step)}/${rest}`);
const SESSION = `sessions/${encodeURIComponent(sessionName)}`;

export const listCourse = () => request("get", "course") as Promise<Schemas["CourseState"]>;
export const readExercise = (exercise: string) =>
  request("get", pathOf(exercise)) as Promise<Exercise>;
export const putPlace = (exercise: string, step: string) =>
  request("put", pathOf(exercise, "/place"), { step }) as Promise<Exercise>;
export const putAnswer = (exercise: string, step: string, answer: number | string) =>
  request("put", stepOf(exercise, step, "answer"), { answer }) as Promise<Exercise>;
export const checkRun = (exercise: string, step: string, run: string) =>
  request("post", stepOf(exercise, step, "check"), { run_id: run }, WORK_TIMEOUT_MS) as Promise<
    CriterionResult[]
  >;
export const putLaw = (exercise: string, law: string) =>
  request("put", pathOf(exercise, "/law"), { text: law }, WORK_TIMEOUT_MS) as Promise<Exercise>;
export const submit = (exercise: string, student: string) =>
  request(
    "post",
    pathOf(exercise, "/submission"),
    { student },
    WORK_TIMEOUT_MS,
  ) as Promise<Judgement>;
/** Set up this page's session for an experiment, at t = 0 and paused. */
export const setUpStep = (exercise: string, step: string) =>
  request("post", `${SESSION}/experiment`, {
    from: "exercise",
    exercise,
    step,
  }) as Promise<SessionState>;
/** Restore the settings from before the exercise, at t = 0. */
export const restoreSettings = () =>
  request("post", `${SESSION}/experiment`, { from: "before_exercise" }) as Promise<SessionState>;
/** The run is named after its exercise and step. */
export const recordStep = (name: string) =>
  request("post", `${SESSION}/recording`, {
    name,
    tags: ["course"],
    notes: "",
  }) as Promise<SessionState>;
// Grades: of the whole class for its instructor, and the student's own.

export type Grades = Schemas["GradesState"];
export type Student = Schemas["StudentState"];
export type Submission = Schemas["GradedSubmissionState"];
export type Grade = NonNullable<Submission["grade"]>;

/** The first request tests whether this machine can isolate a law. */
export const readGrades = () =>
  request("get", "grades", undefined, WORK_TIMEOUT_MS) as Promise<Grades>;
export const gradeClass = (again: boolean) => request("post", "grades", { again }) as Promise<Job>;
export const readOwnGrades = async () =>
  (await readGrades()).students.flatMap(({ submissions }) => submissions);

const addressOf = (format: string): string => new URL(`grades?format=${format}`, API).href;
export const GRADES_CSV = addressOf("csv");
/** The whole class for its instructor; for a student the student's own grades. */
export const GRADES_PAGE = addressOf("html");
export const pageOfStudent = (person: string): string =>
  `${GRADES_PAGE}&person=${encodeURIComponent(person)}`;
