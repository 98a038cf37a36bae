import { isPrivate } from "../../core/api/request";
import { phase, session } from "../../core/state/session";
import { text } from "../../core/text/en";
import { SessionOrigin } from "./sessionorigin";

/** Says that the page shows a private session, or that it has ended, and leads back. */
export function PrivateBanner() {
  if (!isPrivate) return null;
  const branch = session.value?.branch_of;
  const note = session.value?.note;
  const isEnded = phase.value === "ended";
  return (
    <aside class="private-banner" aria-label={text.private.label}>
      <p role="status">
        <strong>{isEnded ? text.private.endedTitle : text.private.title}</strong>{" "}
        {isEnded ? text.private.endedText : text.private.text}{" "}
        {branch && <SessionOrigin runId={branch.run_id} tick={branch.tick} />}
      </p>
      {note && <p role="note">{note}</p>}
      <a class={`button ${isEnded ? "is-primary" : ""}`} href={location.pathname}>
        {text.private.back}
      </a>
    </aside>
  );
}
