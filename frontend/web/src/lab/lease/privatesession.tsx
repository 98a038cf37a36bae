import { isPrivate } from "../../core/api/request";
import { openOwnSession } from "../../core/state/control";
import { text } from "../../core/text/en";

const words = text.control;

/** Leaves the shared session for one of the user alone. */
export function PrivateSessionButton() {
  if (isPrivate) return null;
  return (
    <button
      type="button"
      class="button"
      title={words.privateHint}
      onClick={() => void openOwnSession()}
    >
      {words.private}
    </button>
  );
}
