/** The grade of what was submitted, once there is one. */
import { useEffect, useState } from "preact/hooks";
import { OWN_PAGE, readOwnGrades, type Submission } from "../../core/api/course";
import { explain } from "../../core/state/actions";
import { text } from "../../core/text/en";
import { Criteria, formatPoints, VerifiedRuns } from "../../core/widgets/criteria";

const words = text.grades;

export function OwnGrade({ exercise }: { exercise: string }) {
  const [submission, setSubmission] = useState<Submission | null>(null);
  const [problem, setProblem] = useState("");
  useEffect(() => {
    let isGone = false;
    readOwnGrades().then(
      (all) => {
        if (!isGone) setSubmission(all.find((one) => one.exercise === exercise) ?? null);
      },
      (error) => {
        if (!isGone) setProblem(explain(error));
      },
    );
    return () => {
      isGone = true;
    };
  }, [exercise]);
  if (problem !== "") return <p class="problem">{problem}</p>;
  if (submission === null) return null;
  const { grade } = submission;
  return (
    <section class="lesson-grade" aria-labelledby="lesson-grade">
      <h4 id="lesson-grade">
        {grade === null
          ? words.noOwn
          : words.own(formatPoints(grade.points), formatPoints(grade.max_points))}
      </h4>
      {grade === null && <p class="hint">{submission.problem || words.waits}</p>}
      {grade !== null && (
        <>
          <Criteria grade={grade} />
          <VerifiedRuns grade={grade} />
          <a href={OWN_PAGE} target="_blank" rel="noopener">
            {words.ownPage}
          </a>
        </>
      )}
    </section>
  );
}
