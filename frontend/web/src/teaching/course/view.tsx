import { useEffect, useRef } from "preact/hooks";
import type { Exercise, Step } from "../../core/api/course";
import { Prose } from "../../core/equations/formula";
import { text } from "../../core/text/en";
import { ErrorLine } from "../../core/widgets/form";
import { PlaceLink, place } from "../../runs/list/place";
import { Trial } from "./experiment";
import { exercise, openExercise, problem, step, storePlace } from "./lesson";
import { Prediction } from "./prediction";
import { Question } from "./question";
import { SubmissionPanel } from "./submission";

const words = text.lesson;

function Steps({ found, at }: { found: Exercise; at: Step }) {
  return (
    <nav aria-label={words.steps}>
      <ol class="row lesson-steps">
        {found.parts.map((one, index) => (
          <li key={one.name} class={one.done ? "is-done" : ""}>
            <PlaceLink
              to={{ kind: "learn", exercise: found.name, step: one.name }}
              class="button is-icon"
              title={`${words.kinds[one.kind]}: ${one.title}`}
              isHere={one.name === at.name}
            >
              <span aria-hidden="true">{one.done ? "✓" : index + 1}</span>
              <span class="visually-hidden">
                {words.kinds[one.kind]}: {one.title}
                {one.done && `, ${words.stepDone}`}
              </span>
            </PlaceLink>
          </li>
        ))}
      </ol>
    </nav>
  );
}

/** If a result replaces a form, the focus moves from the form to the result. */
function Task({ found, at }: { found: Exercise; at: Step }) {
  const box = useRef<HTMLDivElement>(null);
  const onDone = () => {
    if (document.activeElement === document.body) box.current?.focus();
  };
  const given = { of: at, exercise: found, onDone };
  return (
    <div ref={box} class="stack" tabIndex={-1} key={at.name}>
      {at.kind === "predict" && <Prediction {...given} />}
      {at.kind === "experiment" && <Trial {...given} />}
      {at.kind === "explain" && <Question {...given} />}
      {at.kind === "submit" && <SubmissionPanel {...given} />}
    </div>
  );
}

function Turn({ found, at }: { found: Exercise; at: Step }) {
  const index = found.parts.findIndex(({ name }) => name === at.name);
  const link = (to: Step | undefined, word: string, look: string) =>
    to && (
      <PlaceLink class={look} to={{ kind: "learn", exercise: found.name, step: to.name }}>
        {word}
      </PlaceLink>
    );
  return (
    <p class="spread divided">
      {link(found.parts[index - 1], `← ${words.previous}`, "button")}
      {link(
        found.parts[index + 1],
        `${words.next} →`,
        at.done || at.kind === "read" ? "button is-primary" : "button",
      )}
    </p>
  );
}

const asLoaded = place.peek();

/** An exercise at a step, next to the live lab. */
export function Lesson({ name }: { name: string }) {
  const found = exercise.value;
  const at = step.value;
  const heading = useRef<HTMLHeadingElement>(null);
  useEffect(() => {
    void openExercise(name);
  }, [name]);
  const here = found?.name === name && at !== null ? at.name : "";
  useEffect(() => {
    if (here === "") return;
    void storePlace(name, here);
    if (place.peek() !== asLoaded) heading.current?.focus();
  }, [name, here]);
  return (
    <section class="surface stack lesson" aria-label={words.label(found?.title ?? name)}>
      <p class="spread hint">
        <PlaceLink to={{ kind: "learn", exercise: "", step: "" }}>← {words.all}</PlaceLink>
        {found && (
          <span>
            {words.exercise(found.number)} ·{" "}
            {words.pointsAndLaw(found.max_points, found.law_points)}
          </span>
        )}
      </p>
      {found !== null && at !== null && found.name === name ? (
        <>
          <h2>{found.title}</h2>
          <progress
            value={found.done}
            max={found.steps}
            aria-label={words.progress}
            title={words.done(found.done, found.steps)}
          />
          <Steps found={found} at={at} />
          {at === found.parts[0] && (
            <div class="stack">
              <p translate>
                <strong>{words.goal}:</strong> {found.goal}
              </p>
              <Prose html={found.html} />
            </div>
          )}
          <h3 class="line" ref={heading} tabIndex={-1}>
            <small class="tag tone is-accent">{words.kinds[at.kind]}</small> {at.title}
            {at.max_points > 0 && <small class="rigid end">{words.points(at.max_points)}</small>}
          </h3>
          <Prose html={at.html} />
          <Task found={found} at={at} />
          <Turn found={found} at={at} />
        </>
      ) : (
        problem.value === "" && <p class="hint">{words.loading}</p>
      )}
      <ErrorLine>{problem.value}</ErrorLine>
    </section>
  );
}
