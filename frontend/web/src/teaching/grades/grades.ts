/** The grades of a class, the selection, and the running grading. */
import { computed, signal } from "@preact/signals";
import { gradeClass, readGrades, type Student, type Submission } from "../../core/api/course";
import { followResults } from "../../core/jobs/results";

const results = followResults("grading", readGrades);
export const { result: grades, problem, job, open: openGrades, unfollow, cancel } = results;
/** User and exercise whose points are shown by criterion. */
export const selection = signal<{ person: string; exercise: string } | null>(null);

export const submissionOf = (student: Student, exercise: string): Submission | undefined =>
  student.submissions.find((submission) => submission.exercise === exercise);

export const selectedSubmission = computed(() => {
  const at = selection.value;
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

/** Number of submissions without a grade. */
export const ungraded = computed(() =>
  (grades.value?.students ?? [])
    .flatMap(({ submissions }) => submissions)
    .reduce((count, { grade }) => count + (grade === null ? 1 : 0), 0),
);

/** Total points of all graded exercises, null without any. */
export function sumOf(student: Student): { points: number; maximum: number } | null {
  const ownGrades = student.submissions.flatMap(({ grade }) => grade ?? []);
  if (ownGrades.length === 0) return null;
  return {
    points: ownGrades.reduce((sum, grade) => sum + grade.points, 0),
    maximum: ownGrades.reduce((sum, grade) => sum + grade.max_points, 0),
  };
}

/** Grade the ungraded submissions, or all of them again. */
export async function gradeAll(isRegrade: boolean): Promise<void> {
  const startedJob = await results.perform("grade", () => gradeClass(isRegrade));
  if (startedJob !== null) await results.follow(startedJob);
}
