import { useEffect } from "preact/hooks";
import type { ExerciseSummary } from "../../core/api/course";
import { EquationCard } from "../../core/equations/equation";
import { TOPICS, type Topic } from "../../core/equations/equations";
import { text } from "../../core/text/en";
import { Page } from "../../core/widgets/pagelayout";
import { goTo, PlaceLink } from "../../runs/list/place";
import { Claims } from "./claims";
import { exercises, openCourse, problem } from "./lesson";
import { startTour } from "./tour";

const words = text.learning;
const lesson = text.lesson;

function ExerciseCard({ of }: { of: ExerciseSummary }) {
  const isDone = of.submitted_at !== null;
  const word = isDone ? lesson.look : of.done > 0 ? lesson.goOn : lesson.begin;
  return (
    <li class="surface card column exercise-card">
      <p class="hint">
        {lesson.exercise(of.number)} · {lesson.minutes(of.minutes)} ·{" "}
        {lesson.pointsAndLaw(of.max_points, of.law_points)}
      </p>
      <h4>{of.title}</h4>
      <p translate>{of.goal}</p>
      <progress
        value={of.done}
        max={of.steps}
        aria-label={`${lesson.progress}: ${of.title}`}
        title={lesson.done(of.done, of.steps)}
      />
      <p class="spread hint">
        <span>
          {isDone
            ? lesson.submitted(of.points ?? 0, of.max_points)
            : lesson.done(of.done, of.steps)}
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
      title={words.title}
      lead={words.lead}
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
          {text.tour.take}
        </button>
      }
    >
      <section class="stack" aria-label={lesson.exercises}>
        <h3>{lesson.exercises}</h3>
        {exercises.value === null && problem.value === "" && <p class="hint">{lesson.loading}</p>}
        <ul class="cells" style={{ "--cell": "320px", gap: "var(--gap)" }}>
          {exercises.value?.map((exercise) => (
            <ExerciseCard key={exercise.name} of={exercise} />
          ))}
        </ul>
      </section>
      <div class="halves">
        <Claims />
        <section class="stack">
          <h3>{words.equations}</h3>
          <p class="hint">{words.equationsHint}</p>
          {TOPICS.map((topic: Topic) => (
            <details key={topic} class="more">
              <summary>{text.equations.topics[topic]}</summary>
              <EquationCard topic={topic} />
            </details>
          ))}
        </section>
      </div>
    </Page>
  );
}
