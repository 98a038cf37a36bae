/** The predicted behaviour of the draft design, and of the settings in use. */
import { signal } from "@preact/signals";
import { type Prediction, predict } from "../../core/api/design";
import { designRequest, isChanged, predictionInputs, requestInUse } from "./draft";
import { createScheduler, watchDesign } from "./scheduler";

export const draftPrediction = signal<Prediction | null>(null);
export const currentPrediction = signal<Prediction | null>(null);
export const isPredicting = signal(false);

const PAUSE_MS = 90;

/** While the panel is open: request again whenever the design or the session changes. */
export function watchPredictions(): () => void {
  const scheduler = createScheduler(PAUSE_MS, async () => {
    const now = currentPrediction.peek() ?? (await predict(requestInUse()));
    const prediction = isChanged.peek() ? await predict(designRequest()) : now;
    return () => {
      currentPrediction.value = now;
      draftPrediction.value = prediction;
      isPredicting.value = false;
    };
  });
  const prepare = (areNew: boolean) => {
    if (areNew) currentPrediction.value = null;
    isPredicting.value = true;
  };
  return watchDesign(predictionInputs, prepare, [scheduler]);
}
