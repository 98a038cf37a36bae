/** Requests about the stability of the draft design. */
import { computed, signal } from "@preact/signals";
import {
  type DesignResponse,
  type Margins,
  requestMargins,
  requestResponse,
  requestStability,
  type Stability,
} from "../../core/api/design";
import { settings } from "../../core/state/arm";
import { designRequest, isChanged, predictionInputs, requestInUse } from "./draft";
import { createScheduler, watchDesign } from "./scheduler";

export const draftResponse = signal<DesignResponse | null>(null);
export const currentResponse = signal<DesignResponse | null>(null);
export const stability = signal<Stability | null>(null);
export const margins = signal<Margins | null>(null);
/** Whether the shown result belongs to other gains than those in the plane. */
export const isStale = signal(false);

const RESPONSE_DELAY_MS = 120;
const STABILITY_DELAY_MS = 450;

/** All inputs of the answers: changes only if a value changes. */
const inputsKey = computed(() => {
  const configuration = settings.value?.configuration;
  return JSON.stringify([configuration?.actuator, configuration?.nominal, predictionInputs.value]);
});

/** While the panel is open: request again whenever the design or the session changes. */
export function watchStability(): () => void {
  const responseScheduler = createScheduler(RESPONSE_DELAY_MS, async () => {
    const now = currentResponse.peek() ?? (await requestResponse(requestInUse()));
    const response = isChanged.peek() ? await requestResponse(designRequest()) : now;
    return () => {
      currentResponse.value = now;
      draftResponse.value = response;
    };
  });
  const stabilityScheduler = createScheduler(STABILITY_DELAY_MS, async () => {
    const newStability = await requestStability(designRequest());
    return () => {
      stability.value = newStability;
      isStale.value = false;
    };
  });
  const marginsScheduler = createScheduler(STABILITY_DELAY_MS, async () => {
    const newMargins = await requestMargins(designRequest());
    return () => {
      margins.value = newMargins;
    };
  });
  const prepare = (areNew: boolean) => {
    if (areNew) currentResponse.value = null;
    isStale.value = true;
    margins.value = null;
  };
  return watchDesign(inputsKey, prepare, [responseScheduler, stabilityScheduler, marginsScheduler]);
}
