/** The grade of what was handed in, once there is one. */
import { useEffect, useState } from "preact/hooks";
import { type Handed, OWN_PAGE, readOwnGrades } from "../../core/api/grades";
import { explain } from "../../core/state/actions";
import { text } from "../../core/text/en";
import { Criteria, formatPoints, VerifiedRuns } from "../../core/widgets/criteria";

const words = text.grades;

export function OwnGrade({ exercise }: { exercise: string }) {
  const [handed, setHanded] = useState<Handed | null>(null);
  const [problem, setProblem] = useState("");
  useEffect(() => {
    let isGone = false;
    readOwnGrades().then(
      (all) => {
        if (!isGone) setHanded(all.find((one) => one.exercise === exercise) ?? null);
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
  if (handed === null) return null;
  const { grade } = handed;
  return (
    <section class="lesson-grade" aria-labelledby="lesson-grade">
      <h4 id="lesson-grade">
        {grade === null
          ? words.noOwn
          : words.own(formatPoints(grade.points), formatPoints(grade.max_points))}
      </h4>
      {grade === null && <p class="hint">{handed.problem || words.waits}</p>}
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
