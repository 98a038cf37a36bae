/** What was done is submitted. */
import { useState } from "preact/hooks";
import { isClass } from "../../core/state/control";
import { personName } from "../../core/state/preferences";
import { text } from "../../core/text/en";
import { PlaceLink } from "../../runs/list/placelink";
import { isBusy, submit } from "./lesson";
import { OwnGrade } from "./owngrade";
import { OwnLaw } from "./ownlaw";
import type { Task } from "./task";

const words = text.lesson;

export function Ending({ of, exercise, onDone }: Task) {
  const [name, setName] = useState(personName.peek());
  if (exercise.submitted_at !== null) {
    return (
      <>
        <p class="lesson-submission" role="status">
          <strong>{words.submitted(exercise.points ?? 0, exercise.max_points)}</strong>
          {of.law && <span>{words.law.later(exercise.law_points)}</span>}
        </p>
        <OwnGrade exercise={exercise.name} />
      </>
    );
  }
  const missing = exercise.parts.filter((one) => exercise.missing.includes(one.name));
  return (
    <>
      {of.law && <OwnLaw kept={exercise.law} html={of.html} />}
      <form
        class="lesson-form"
        onSubmit={async (event) => {
          event.preventDefault();
          await submit(name);
          requestAnimationFrame(onDone);
        }}
      >
        {missing.length > 0 && (
          <div class="lesson-missing">
            <p>{words.missing}</p>
            <ul>
              {missing.map((one) => (
                <li key={one.name}>
                  {one.name === of.name ? (
                    words.law.tryFirst
                  ) : (
                    <PlaceLink to={{ kind: "learn", exercise: exercise.name, step: one.name }}>
                      {one.title}
                    </PlaceLink>
                  )}
                </li>
              ))}
            </ul>
          </div>
        )}
        {!isClass.value && (
          <label>
            <span>{words.name}</span>
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
          title={words.submitHint}
          disabled={missing.length > 0 || isBusy.value}
        >
          {words.submit}
        </button>
        <small>{words.submitHint}</small>
      </form>
    </>
  );
}
