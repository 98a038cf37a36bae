import { useId, useState } from "preact/hooks";
import {
  CONTROL_OF_SESSION,
  confirmControl,
  isControlDialogOpen,
  otherHolder,
  queue,
  requestControl,
} from "../../core/state/control";
import { defaultName, MAX_NAME_LENGTH, personName } from "../../core/state/preferences";
import { isLive } from "../../core/state/session";
import { text } from "../../core/text/en";
import { Banner } from "../../core/widgets/banner";
import { Problem } from "../../core/widgets/form";
import { QueueStatus } from "./queuestatus";

const words = text.control;

/** Dialog for a missing name, and to confirm taking control from its holder. */
function Question({ other }: { other: string | null }) {
  const id = useId();
  const [name, setName] = useState(personName.peek().trim() || defaultName());
  const [isNameKnown] = useState(personName.peek().trim() !== "");
  const submit = (event: Event) => {
    event.preventDefault();
    void confirmControl(name);
  };
  return (
    <form class="row banner is-news is-calm" aria-label={words.heading} onSubmit={submit}>
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
            maxLength={MAX_NAME_LENGTH}
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
          isControlDialogOpen.value = false;
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
      <button type="button" class="button" disabled={!isLive.value} onClick={requestControl}>
        {words.takeOver}
      </button>
    </Banner>
  );
}

/** Reports that another user is in control, and asks for confirmation before this page takes it. */
export function ControlBanner() {
  const other = otherHolder.value;
  return (
    <>
      {isControlDialogOpen.value ? (
        <Question other={other} />
      ) : queue.value !== null ? (
        <QueueStatus queue={queue.value} />
      ) : (
        other !== null && <Held other={other} />
      )}
      <Problem control={CONTROL_OF_SESSION} />
    </>
  );
}
