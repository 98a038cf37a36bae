/** Grades: a class's, for its instructor, and one's own. */
import type { Job } from "./jobs";
import { API, request } from "./request";
import type { components } from "./schema";

type Schemas = components["schemas"];

export type Grades = Schemas["GradesState"];
export type Student = Schemas["StudentState"];
export type Submission = Schemas["GradedSubmissionState"];
export type Grade = NonNullable<Submission["grade"]>;
export type Criterion = Grade["criteria"][number];

/** Whether this machine isolates a law is tried before the first answer. */
const LONG_WAIT_MS = 60_000;

export const readGrades = () =>
  request("get", "grades", undefined, LONG_WAIT_MS) as Promise<Grades>;
export const gradeClass = (again: boolean) => request("post", "grades", { again }) as Promise<Job>;
export const readOwnGrades = () => request("get", "grades/mine") as Promise<Submission[]>;

const addressOf = (path: string): string => new URL(`grades/${path}`, API).href;
export const GRADES_CSV = addressOf("class.csv");
export const GRADES_PAGE = addressOf("class.html");
export const OWN_PAGE = addressOf("mine.html");
export const pageOfStudent = (person: string): string =>
  `${GRADES_PAGE}?person=${encodeURIComponent(person)}`;
