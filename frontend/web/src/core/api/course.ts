/** The course: exercises, progress, judged runs and grades. */

import type { Job } from "./jobs";
import { API, request, sessionName } from "./request";
import type { components } from "./schema";
import type { SessionState } from "./types";

type Schemas = components["schemas"];

export type ExerciseSummary = Schemas["ExerciseSummary"];
export type Exercise = Schemas["ExerciseState"];
export type Step = Schemas["StepState"];
export type CriterionResult = Schemas["CriterionResult"];
type Judgement = Schemas["Judgement"];

const LONG_WAIT_MS = 60_000;
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
  request("post", stepOf(exercise, step, "check"), { run_id: run }, LONG_WAIT_MS) as Promise<
    CriterionResult[]
  >;
export const putLaw = (exercise: string, law: string) =>
  request("put", pathOf(exercise, "/law"), { text: law }, LONG_WAIT_MS) as Promise<Exercise>;
export const submit = (exercise: string, student: string) =>
  request("post", pathOf(exercise, "/submission"), { student }, LONG_WAIT_MS) as Promise<Judgement>;
/** Sets this page's session as an experiment asks, at t = 0 and paused. */
export const setUpStep = (exercise: string, step: string) =>
  request("post", `${SESSION}/experiment`, {
    from: "exercise",
    exercise,
    step,
  }) as Promise<SessionState>;
/** The settings from before the exercise, at t = 0. */
export const restoreSettings = () =>
  request("post", `${SESSION}/experiment`, { from: "before_exercise" }) as Promise<SessionState>;
/** The run is called by its exercise and step. */
export const recordStep = (name: string) =>
  request("post", `${SESSION}/recording`, {
    name,
    tags: ["course"],
    notes: "",
  }) as Promise<SessionState>;
/** The name of a private session of one's own. */
export const openOwnSession = async () =>
  ((await request("post", "sessions", {}, LONG_WAIT_MS)) as SessionState).session;

// Grades: a class's, for its instructor, and one's own.

export type Grades = Schemas["GradesState"];
export type Student = Schemas["StudentState"];
export type Submission = Schemas["GradedSubmissionState"];
export type Grade = NonNullable<Submission["grade"]>;

/** Whether this machine isolates a law is tried before the first answer. */
export const readGrades = () =>
  request("get", "grades", undefined, LONG_WAIT_MS) as Promise<Grades>;
export const gradeClass = (again: boolean) => request("post", "grades", { again }) as Promise<Job>;
export const readOwnGrades = async () =>
  (await readGrades()).students.flatMap(({ submissions }) => submissions);

const addressOf = (format: string): string => new URL(`grades?format=${format}`, API).href;
export const GRADES_CSV = addressOf("csv");
/** Of the class for its instructor; of a student the own grades. */
export const GRADES_PAGE = addressOf("html");
export const pageOfStudent = (person: string): string =>
  `${GRADES_PAGE}&person=${encodeURIComponent(person)}`;
