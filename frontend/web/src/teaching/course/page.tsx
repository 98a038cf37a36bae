import { useEffect } from "preact/hooks";
import type { ExerciseSummary } from "../../core/api/course";
import { EquationCard } from "../../core/equations/equation";
import { TOPICS, type Topic } from "../../core/equations/equations";
import { t } from "../../core/text/t";
import { Page } from "../../core/widgets/pagelayout";
import { goTo, PlaceLink } from "../../runs/list/place";
import { Claims } from "./claims";
import { exercises, openCourse, problem } from "./lesson";
import { startTour } from "./tour";

function ExerciseCard({ of }: { of: ExerciseSummary }) {
  const isDone = of.submitted_at !== null;
  const word = isDone ? t("lesson.look") : of.done > 0 ? t("lesson.goOn") : t("lesson.begin");
  return (
    <li class="surface card column">
      <p class="hint">
        {t("lesson.exercise", { number: of.number })} ·{" "}
        {t("lesson.minutes", { minutes: of.minutes })} ·{" "}
        {of.law_points > 0
          ? t("lesson.pointsAndLaw", { points: of.max_points, law: of.law_points })
          : t("lesson.points", { count: of.max_points })}
      </p>
      <h4>{of.title}</h4>
      <p class="grow" translate>
        {of.goal}
      </p>
      <progress
        value={of.done}
        max={of.steps}
        aria-label={`${t("lesson.progress")}: ${of.title}`}
        title={t("lesson.done", { done: of.done, all: of.steps })}
      />
      <p class="spread hint">
        <span>
          {isDone
            ? t("lesson.submitted", { points: of.points ?? 0, most: of.max_points })
            : t("lesson.done", { done: of.done, all: of.steps })}
        </span>
        <PlaceLink
          class={isDone ? "button" : "button is-primary"}
          to={{ kind: "learn", exercise: of.name, step: of.at ?? "" }}
          title={`${word}: ${of.title}`}
        >
          {word}
          <span class="visually-hidden">: {of.title}</span>
        </PlaceLink>
      </p>
    </li>
  );
}

/** Exercises, the paper's claims, the equations and the tour. */
export function LearnPage() {
  useEffect(() => {
    void openCourse();
  }, []);
  return (
    <Page
      title={t("learning.title")}
      lead={t("learning.lead")}
      problem={problem.value}
      class="learn"
      aside={
        <button
          type="button"
          class="button"
          onClick={() => {
            goTo({ kind: "lab" });
            startTour();
          }}
        >
          {t("tour.take")}
        </button>
      }
    >
      <section class="stack" aria-label={t("lesson.exercises")}>
        <h3>{t("lesson.exercises")}</h3>
        {exercises.value === null && problem.value === "" && (
          <p class="hint">{t("lesson.loading")}</p>
        )}
        <ul class="cells" style={{ "--cell": "320px", gap: "var(--gap)" }}>
          {exercises.value?.map((exercise) => (
            <ExerciseCard key={exercise.name} of={exercise} />
          ))}
        </ul>
      </section>
      <div class="halves">
        <Claims />
        <section class="stack">
          <h3>{t("learning.equations")}</h3>
          <p class="hint">{t("learning.equationsHint")}</p>
          {TOPICS.map((topic: Topic) => (
            <details key={topic} class="more">
              <summary>{t(`equations.topics.${topic}`)}</summary>
              <EquationCard topic={topic} />
            </details>
          ))}
        </section>
      </div>
    </Page>
  );
}
