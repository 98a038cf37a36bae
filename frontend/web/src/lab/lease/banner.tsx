import { useId, useState } from "preact/hooks";
import {
  CONTROL_OF_SESSION,
  confirmControl,
  isAsked,
  otherHolder,
  queue,
  wishControl,
} from "../../core/state/control";
import { defaultName, LONGEST_NAME, personName } from "../../core/state/preferences";
import { isLive } from "../../core/state/session";
import { text } from "../../core/text/en";
import { Banner } from "../../core/widgets/banner";
import { Problem } from "../../core/widgets/form";
import { InTurn } from "./inturn";

const words = text.control;

/** Asks for a name if none is known, and before control is taken from its holder. */
function Question({ other }: { other: string | null }) {
  const id = useId();
  const [name, setName] = useState(personName.peek().trim() || defaultName());
  const [isNameKnown] = useState(personName.peek().trim() !== "");
  const submit = (event: Event) => {
    event.preventDefault();
    void confirmControl(name);
  };
  return (
    <form class="banner is-news is-calm" aria-label={words.heading} onSubmit={submit}>
      <p>
        <strong>{other === null ? words.askTitle : words.askOverTitle(other)}</strong>{" "}
        {other !== null && words.askOverText}
      </p>
      {!isNameKnown && (
        <>
          <label for={id}>{words.name}</label>
          <input
            id={id}
            type="text"
            required
            maxLength={LONGEST_NAME}
            autocomplete="name"
            value={name}
            onInput={(event) => setName(event.currentTarget.value)}
          />
        </>
      )}
      <button type="submit" class="button is-primary" disabled={!isLive.value}>
        {words.take}
      </button>
      <button
        type="button"
        class="button"
        onClick={() => {
          isAsked.value = false;
        }}
      >
        {words.cancel}
      </button>
    </form>
  );
}

function Held({ other }: { other: string }) {
  return (
    <Banner look="is-news is-calm" sign="▪" title={words.heldTitle(other)} words={words.heldText}>
      <button type="button" class="button" disabled={!isLive.value} onClick={wishControl}>
        {words.takeOver}
      </button>
    </Banner>
  );
}

/** Reports that another user is in control, and asks before this page takes it. */
export function ControlBanner() {
  const other = otherHolder.value;
  return (
    <>
      {isAsked.value ? (
        <Question other={other} />
      ) : queue.value !== null ? (
        <InTurn queue={queue.value} />
      ) : (
        other !== null && <Held other={other} />
      )}
      <Problem control={CONTROL_OF_SESSION} />
    </>
  );
}
