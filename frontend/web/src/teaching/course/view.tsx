import { useEffect, useRef } from "preact/hooks";
import type { Exercise, Step } from "../../core/api/course";
import { Prose } from "../../core/equations/formula";
import { t } from "../../core/text/t";
import { ErrorLine } from "../../core/widgets/form";
import { PlaceLink, place } from "../../runs/list/place";
import { Trial } from "./experiment";
import { exercise, openExercise, problem, step, storePlace } from "./lesson";
import { Prediction } from "./prediction";
import { Question } from "./question";
import { SubmissionPanel } from "./submission";

function Steps({ shownExercise, at }: { shownExercise: Exercise; at: Step }) {
  return (
    <nav aria-label={t("lesson.steps")}>
      <ol class="row">
        {shownExercise.parts.map((part, index) => (
          <li key={part.name}>
            <PlaceLink
              to={{ kind: "learn", exercise: shownExercise.name, step: part.name }}
              class={`button is-icon ${part.done && part !== at ? "good" : ""}`}
              title={`${t(`lesson.kinds.${part.kind}`)}: ${part.title}`}
              isHere={part.name === at.name}
            >
              <span aria-hidden="true">{part.done ? "✓" : index + 1}</span>
              <span class="visually-hidden">
                {t(`lesson.kinds.${part.kind}`)}: {part.title}
                {part.done && `, ${t("lesson.stepDone")}`}
              </span>
            </PlaceLink>
          </li>
        ))}
      </ol>
    </nav>
  );
}

/** If a result replaces a form, the focus moves from the form to the result. */
function Task({ shownExercise, at }: { shownExercise: Exercise; at: Step }) {
  const box = useRef<HTMLDivElement>(null);
  const onDone = () => {
    if (document.activeElement === document.body) box.current?.focus();
  };
  const taskProps = { of: at, exercise: shownExercise, onDone };
  return (
    <div ref={box} class="stack" tabIndex={-1} key={at.name}>
      {at.kind === "predict" && <Prediction {...taskProps} />}
      {at.kind === "experiment" && <Trial {...taskProps} />}
      {at.kind === "explain" && <Question {...taskProps} />}
      {at.kind === "submit" && <SubmissionPanel {...taskProps} />}
    </div>
  );
}

function Turn({ shownExercise, at }: { shownExercise: Exercise; at: Step }) {
  const index = shownExercise.parts.findIndex(({ name }) => name === at.name);
  const link = (to: Step | undefined, word: string, look: string) =>
    to && (
      <PlaceLink class={look} to={{ kind: "learn", exercise: shownExercise.name, step: to.name }}>
        {word}
      </PlaceLink>
    );
  return (
    <p class="spread divided">
      {link(shownExercise.parts[index - 1], `← ${t("lesson.previous")}`, "button")}
      {link(
        shownExercise.parts[index + 1],
        `${t("lesson.next")} →`,
        at.done || at.kind === "read" ? "button is-primary" : "button",
      )}
    </p>
  );
}

const asLoaded = place.peek();

/** An exercise at a step, next to the live lab. */
export function Lesson({ name }: { name: string }) {
  const shownExercise = exercise.value;
  const at = step.value;
  const heading = useRef<HTMLHeadingElement>(null);
  useEffect(() => {
    void openExercise(name);
  }, [name]);
  const here = shownExercise?.name === name && at !== null ? at.name : "";
  useEffect(() => {
    if (here === "") return;
    void storePlace(name, here);
    if (place.peek() !== asLoaded) heading.current?.focus();
  }, [name, here]);
  return (
    <section
      class="surface card stack"
      aria-label={t("lesson.label", { title: shownExercise?.title ?? name })}
    >
      <p class="spread hint">
        <PlaceLink to={{ kind: "learn", exercise: "", step: "" }}>← {t("lesson.all")}</PlaceLink>
        {shownExercise && (
          <span>
            {t("lesson.exercise", { number: shownExercise.number })} ·{" "}
            {shownExercise.law_points > 0
              ? t("lesson.pointsAndLaw", {
                  points: shownExercise.max_points,
                  law: shownExercise.law_points,
                })
              : t("lesson.points", { count: shownExercise.max_points })}
          </span>
        )}
      </p>
      {shownExercise !== null && at !== null && shownExercise.name === name ? (
        <>
          <h2>{shownExercise.title}</h2>
          <progress
            value={shownExercise.done}
            max={shownExercise.steps}
            aria-label={t("lesson.progress")}
            title={t("lesson.done", { done: shownExercise.done, all: shownExercise.steps })}
          />
          <Steps shownExercise={shownExercise} at={at} />
          {at === shownExercise.parts[0] && (
            <div class="stack">
              <p translate>
                <strong>{t("lesson.goal")}:</strong> {shownExercise.goal}
              </p>
              <Prose html={shownExercise.html} />
            </div>
          )}
          <h3 class="line" ref={heading} tabIndex={-1}>
            <small class="tag tone is-accent">{t(`lesson.kinds.${at.kind}`)}</small> {at.title}
            {at.max_points > 0 && (
              <small class="rigid end">{t("lesson.points", { count: at.max_points })}</small>
            )}
          </h3>
          <Prose html={at.html} />
          <Task shownExercise={shownExercise} at={at} />
          <Turn shownExercise={shownExercise} at={at} />
        </>
      ) : (
        problem.value === "" && <p class="hint">{t("lesson.loading")}</p>
      )}
      <ErrorLine>{problem.value}</ErrorLine>
    </section>
  );
}
