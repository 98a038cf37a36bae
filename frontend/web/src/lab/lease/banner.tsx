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
import { t } from "../../core/text/t";
import { Banner } from "../../core/widgets/banner";
import { Problem } from "../../core/widgets/form";
import { QueueStatus } from "./queuestatus";

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
    <form class="row banner is-accent" aria-label={t("control.heading")} onSubmit={submit}>
      <p>
        <strong>
          {other === null ? t("control.askTitle") : t("control.askOverTitle", { name: other })}
        </strong>{" "}
        {other !== null && t("control.askOverText")}
      </p>
      {!isNameKnown && (
        <>
          <label for={id}>{t("control.name")}</label>
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
        {t("control.take")}
      </button>
      <button
        type="button"
        class="button"
        onClick={() => {
          isControlDialogOpen.value = false;
        }}
      >
        {t("control.cancel")}
      </button>
    </form>
  );
}

function Held({ other }: { other: string }) {
  return (
    <Banner
      look="is-accent"
      sign="▪"
      title={t("control.heldTitle", { name: other })}
      words={t("control.heldText")}
    >
      <button type="button" class="button" disabled={!isLive.value} onClick={requestControl}>
        {t("control.takeOver")}
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
