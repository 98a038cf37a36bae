/** Submission of an exercise. */
import { useEffect, useState } from "preact/hooks";
import { GRADES_PAGE, readOwnGrades, type Submission } from "../../core/api/course";
import { isClass } from "../../core/state/access";
import { explain } from "../../core/state/actions";
import { personName } from "../../core/state/preferences";
import { t } from "../../core/text/t";
import { Criteria, formatPoints, VerifiedRuns } from "../../core/widgets/criteria";
import { PlaceLink } from "../../runs/list/place";
import { isBusy, submit, type TaskProps } from "./lesson";
import { OwnLaw } from "./ownlaw";

export function SubmissionPanel({ of, exercise, onDone }: TaskProps) {
  const [name, setName] = useState(personName.peek());
  if (exercise.submitted_at !== null) {
    return (
      <>
        <p class="note" role="status">
          <strong>
            {t("lesson.submitted", { points: exercise.points ?? 0, most: exercise.max_points })}
          </strong>
          {of.law && <span>{t("lesson.law.later", { points: exercise.law_points })}</span>}
        </p>
        <OwnGrade exercise={exercise.name} />
      </>
    );
  }
  const missing = exercise.parts.filter((part) => exercise.missing.includes(part.name));
  return (
    <>
      {of.law && <OwnLaw savedLaw={exercise.law} html={of.html} />}
      <form
        class="stack form lesson-form"
        onSubmit={async (event) => {
          event.preventDefault();
          await submit(name);
          requestAnimationFrame(onDone);
        }}
      >
        {missing.length > 0 && (
          <div class="note">
            <p>{t("lesson.missing")}</p>
            <ul class="bullets">
              {missing.map((part) => (
                <li key={part.name}>
                  {part.name === of.name ? (
                    t("lesson.law.tryFirst")
                  ) : (
                    <PlaceLink to={{ kind: "learn", exercise: exercise.name, step: part.name }}>
                      {part.title}
                    </PlaceLink>
                  )}
                </li>
              ))}
            </ul>
          </div>
        )}
        {!isClass.value && (
          <label>
            <span>{t("lesson.name")}</span>
            <input
              type="text"
              maxLength={100}
              autocomplete="name"
              value={name}
              onInput={({ currentTarget }) => setName(currentTarget.value)}
            />
          </label>
        )}
        <button
          type="submit"
          class="button is-primary"
          title={t("lesson.submitHint")}
          disabled={missing.length > 0 || isBusy.value !== ""}
        >
          {t("lesson.submit")}
        </button>
        <small>{t("lesson.submitHint")}</small>
      </form>
    </>
  );
}

// The grade of the submission, once there is one.

function OwnGrade({ exercise }: { exercise: string }) {
  const [submission, setSubmission] = useState<Submission | null>(null);
  const [problem, setProblem] = useState("");
  useEffect(() => {
    let isGone = false;
    readOwnGrades().then(
      (all) => {
        if (!isGone) setSubmission(all.find((entry) => entry.exercise === exercise) ?? null);
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
    <section class="stack" aria-labelledby="lesson-grade">
      <h4 id="lesson-grade">
        {grade === null
          ? t("grades.noOwn")
          : t("grades.own", {
              points: formatPoints(grade.points),
              most: formatPoints(grade.max_points),
            })}
      </h4>
      {grade === null && <p class="hint">{submission.problem || t("grades.waits")}</p>}
      {grade !== null && (
        <>
          <Criteria grade={grade} />
          <VerifiedRuns grade={grade} />
          <a href={GRADES_PAGE} target="_blank" rel="noopener">
            {t("grades.ownPage")}
          </a>
        </>
      )}
    </section>
  );
}
