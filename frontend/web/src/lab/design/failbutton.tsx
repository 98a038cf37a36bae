import { useState } from "preact/hooks";
import { simulateDesign } from "../../core/api/design";
import { explain } from "../../core/state/actions";
import { t } from "../../core/text/t";
import { ErrorLine } from "../../core/widgets/form";
import { designRequest } from "./draft";
import { draftPrediction } from "./predictions";
import { draftResponse, stability } from "./stability";

/** Whether the design would fail: rejected, unstable about rest, or a fault under the 3 kg. */
const wouldFail = () =>
  draftPrediction.value?.verdict === "refuse" ||
  draftPrediction.value?.reasons.some(({ code }) => code === "unstable_loop") === true ||
  (stability.value?.largest_pole ?? 0) >= 1 ||
  (draftResponse.value?.load.fault ?? null) !== null;

/** Run a design that cannot be applied in a private simulation, never on a bench. */
export function FailButton() {
  const [isBusy, setBusy] = useState(false);
  const [problem, setProblem] = useState("");
  if (!wouldFail()) return null;
  const fail = async () => {
    setBusy(true);
    setProblem("");
    try {
      const { session } = await simulateDesign(designRequest());
      location.assign(`${location.pathname}?session=${encodeURIComponent(session)}`);
    } catch (error) {
      setProblem(explain(error));
      setBusy(false);
    }
  };
  return (
    <div class="row">
      <button
        type="button"
        class="button bad"
        title={t("stability.failHint")}
        disabled={isBusy}
        onClick={() => void fail()}
      >
        {t("stability.fail")}
      </button>
      <span class="hint">{t("stability.failNote")}</span>
      <ErrorLine>{problem}</ErrorLine>
    </div>
  );
}
