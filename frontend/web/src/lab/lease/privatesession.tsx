import { isPrivate } from "../../core/api/request";
import { openOwnSession } from "../../core/state/control";
import { t } from "../../core/text/t";

/** Leaves the shared session for one of the user alone. */
export function PrivateSessionButton() {
  if (isPrivate) return null;
  return (
    <button
      type="button"
      class="button"
      title={t("control.privateHint")}
      onClick={() => void openOwnSession()}
    >
      {t("control.private")}
    </button>
  );
}
