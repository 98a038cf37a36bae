import { useEffect } from "preact/hooks";
import {
  GRADES_CSV,
  GRADES_PAGE,
  pageOfStudent,
  type Student,
  type Submission,
} from "../../core/api/course";
import { isJobRunning, JobProgress } from "../../core/jobs/progress";
import { t } from "../../core/text/t";
import { Criteria, formatPoints, VerifiedRuns } from "../../core/widgets/criteria";
import { Page } from "../../core/widgets/pagelayout";
import {
  cancel,
  columns,
  gradeAll,
  grades,
  job,
  openGrades,
  problem,
  selectedSubmission,
  selection,
  submissionOf,
  sumOf,
  unfollow,
  ungraded,
} from "./grades";

/** Cell of a submission in the table. */
function describeSubmission({ grade, problem: why }: Submission): string {
  if (grade !== null)
    return t("grades.of", {
      points: formatPoints(grade.points),
      most: formatPoints(grade.max_points),
    });
  return why === "" ? t("grades.ungraded") : t("grades.refused");
}

function Cell({ student, exercise }: { student: Student; exercise: string }) {
  const submission = submissionOf(student, exercise);
  if (submission === undefined) return <td class="muted">{t("grades.nothing")}</td>;
  const at = selection.value;
  const isShown = at?.person === student.person && at.exercise === exercise;
  return (
    <td>
      <button
        type="button"
        class={submission.problem === "" ? "button is-small" : "button is-small bad"}
        aria-pressed={isShown}
        onClick={() => {
          selection.value = isShown ? null : { person: student.person, exercise };
        }}
      >
        {describeSubmission(submission)}
      </button>
    </td>
  );
}

/** One row per student, one column per exercise; a click on a number shows it by criterion. */
function Table() {
  return (
    <section class="surface card scroll" aria-label={t("grades.table")}>
      <table class="table">
        <caption class="visually-hidden">{t("grades.tableHint")}</caption>
        <thead>
          <tr>
            <th scope="col">{t("grades.student")}</th>
            {columns.value.map((exercise) => (
              <th key={exercise.name} scope="col">
                {exercise.number}. {exercise.title}
              </th>
            ))}
            <th scope="col">{t("grades.sum")}</th>
          </tr>
        </thead>
        <tbody>
          {grades.value?.students.map((student) => {
            const sum = sumOf(student);
            return (
              <tr key={student.person}>
                <th scope="row">
                  <a
                    href={pageOfStudent(student.person)}
                    target="_blank"
                    rel="noopener"
                    title={t("grades.report", { name: student.name })}
                  >
                    {student.name}
                  </a>
                  <small class="block nowrap">{student.person}</small>
                </th>
                {columns.value.map(({ name }) => (
                  <Cell key={name} student={student} exercise={name} />
                ))}
                <td>
                  {sum === null
                    ? "–"
                    : t("grades.of", {
                        points: formatPoints(sum.points),
                        most: formatPoints(sum.maximum),
                      })}
                </td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </section>
  );
}

/** One grade by criterion, or the reason why there is none. */
function SelectedGrade() {
  const now = selectedSubmission.value;
  if (now === null) return <p class="hint">{t("grades.pick")}</p>;
  const { student, submission } = now;
  const { grade } = submission;
  const exercise = grades.value?.exercises.find(({ name }) => name === submission.exercise);
  return (
    <section class="surface card" aria-labelledby="grades-picked">
      <h3 id="grades-picked">
        {student.name}: {exercise?.title ?? submission.exercise}
      </h3>
      {submission.problem !== "" && (
        <p class="problem">
          {grade === null ? t("grades.noGrade") : t("grades.keptGrade")} {submission.problem}
        </p>
      )}
      {grade === null ? (
        submission.problem === "" && <p>{t("grades.notYet")}</p>
      ) : (
        <>
          <Criteria grade={grade} />
          <VerifiedRuns grade={grade} />
          <p class="hint breaks">
            {grade.seed == null
              ? t("grades.made", {
                  submission: grade.submission.slice(0, 12),
                  version: grade.version,
                })
              : t("grades.madeSeeded", {
                  submission: grade.submission.slice(0, 12),
                  seed: grade.seed,
                  version: grade.version,
                })}
          </p>
        </>
      )}
    </section>
  );
}

function Acts() {
  const now = job.value;
  const isBusy = isJobRunning(now);
  return (
    <div class="row">
      <button
        type="button"
        class="button is-primary"
        disabled={isBusy || ungraded.value === 0}
        title={t("grades.gradeHint")}
        onClick={() => void gradeAll(false)}
      >
        {ungraded.value === 0
          ? t("grades.allGraded")
          : t("grades.grade", { ungraded: ungraded.value })}
      </button>
      <button
        type="button"
        class="button"
        disabled={isBusy}
        title={t("grades.againHint")}
        onClick={() => void gradeAll(true)}
      >
        {t("grades.again")}
      </button>
      <a class="button" href={GRADES_CSV} download="grades.csv">
        {t("grades.csv")}
      </a>
      <a class="button" href={GRADES_PAGE} target="_blank" rel="noopener">
        {t("grades.page")}
      </a>
      {now !== null && (
        <JobProgress
          job={now}
          done={t("grades.graded", { done: now.done, total: now.total || "…" })}
          total={now.total || 1}
          label={t("grades.grading")}
          onCancel={() => void cancel()}
        />
      )}
    </div>
  );
}

/** A class's grades: graded by running the submissions again, and shown by criterion. */
export function GradesPage() {
  useEffect(() => {
    void openGrades();
    return unfollow;
  }, []);
  const classGrades = grades.value;
  return (
    <Page title={t("grades.title")} lead={t("grades.lead")} problem={problem.value}>
      {classGrades?.not_isolated && (
        <p class="surface card problem">
          {t("grades.notIsolated")} {classGrades.not_isolated}
        </p>
      )}
      {classGrades === null ? (
        problem.value === "" && <p class="hint">{t("grades.loading")}</p>
      ) : classGrades.students.length === 0 ? (
        <section class="surface card">
          <h3>{t("grades.empty")}</h3>
          <p translate>{t("grades.emptyHint")}</p>
        </section>
      ) : (
        <>
          <Acts />
          <Table />
          <SelectedGrade />
        </>
      )}
    </Page>
  );
}
