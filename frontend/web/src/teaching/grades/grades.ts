/** The grades of a class, what of them is looked at, and the grading that is under way. */
import { computed, signal } from "@preact/signals";
import { gradeClass, readGrades, type Student, type Submission } from "../../core/api/course";
import { followResults } from "../../core/jobs/results";

const results = followResults("grading", readGrades);
export const { found: grades, problem, job, open: openGrades, leave, cancel } = results;
/** Person and exercise whose points are shown by criterion. */
export const picked = signal<{ person: string; exercise: string } | null>(null);

export const submissionOf = (student: Student, exercise: string): Submission | undefined =>
  student.submissions.find((one) => one.exercise === exercise);

export const shown = computed(() => {
  const at = picked.value;
  const student = grades.value?.students.find(({ person }) => person === at?.person);
  const submission = student && at && submissionOf(student, at.exercise);
  return student && submission ? { student, submission } : null;
});

/** Exercises with a submission, in their order. */
export const columns = computed(() =>
  (grades.value?.exercises ?? []).filter(({ name }) =>
    grades.value?.students.some((student) => submissionOf(student, name) !== undefined),
  ),
);

/** How many submissions have no grade. */
export const ungraded = computed(() =>
  (grades.value?.students ?? [])
    .flatMap(({ submissions }) => submissions)
    .reduce((count, { grade }) => count + (grade === null ? 1 : 0), 0),
);

/** Points of all that is graded, null where nothing is. */
export function sumOf(student: Student): { points: number; most: number } | null {
  const given = student.submissions.flatMap(({ grade }) => grade ?? []);
  if (given.length === 0) return null;
  return {
    points: given.reduce((sum, one) => sum + one.points, 0),
    most: given.reduce((sum, one) => sum + one.max_points, 0),
  };
}

/** Grades what has no grade, or all of it again. */
export async function gradeAll(again: boolean): Promise<void> {
  const begun = await results.attempt(() => gradeClass(again));
  if (begun !== null) await results.follow(begun);
}
