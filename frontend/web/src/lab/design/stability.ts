/** Requests about the stability of the draft design. */
import { computed, effect, signal } from "@preact/signals";
import {
  type DesignRequest,
  type DesignResponse,
  type Margins,
  requestMargins,
  requestResponse,
  requestStability,
  type Stability,
} from "../../core/api/design";
import { settings } from "../../core/state/arm";
import { draft, isChanged, predictionInputs, requestOf } from "./draft";

export const draftResponse = signal<DesignResponse | null>(null);
export const currentResponse = signal<DesignResponse | null>(null);
export const stability = signal<Stability | null>(null);
export const margins = signal<Margins | null>(null);
/** Whether the shown result belongs to other gains than those in the plane. */
export const isStale = signal(false);

const RESPONSE_DELAY_MS = 120;
const STABILITY_DELAY_MS = 450;
const RETRY_MS = 2500;

/** All inputs of the answers: changes only if a value changes. */
const inputsKey = computed(() => {
  const configuration = settings.value?.configuration;
  return JSON.stringify([configuration?.actuator, configuration?.nominal, predictionInputs.value]);
});
const draftKey = computed(() => JSON.stringify(draft.value));

/** The request for the design in the plane; the settings in use need no body. */
export function designRequest(): DesignRequest {
  const tried = draft.peek();
  return tried !== null && isChanged.peek() ? requestOf(tried) : {};
}

/**
 * Request after a pause; one request at a time, the last one counts; repeated after a rejection.
 */
function createScheduler(
  pauseMs: number,
  request: () => Promise<() => void>,
): { schedule(): void; stop(): void } {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let isBusy = false;
  let number = 0;
  const start = async () => {
    if (isBusy) return;
    isBusy = true;
    const startedNumber = number;
    let isAnswered = false;
    try {
      const applyAnswer = await request();
      isAnswered = true;
      if (startedNumber === number) applyAnswer();
    } catch {
      clearTimeout(timer);
      if (number > 0) timer = setTimeout(() => void start(), RETRY_MS);
    }
    isBusy = false;
    if (isAnswered && startedNumber !== number && number > 0) void start();
  };
  return {
    schedule() {
      number++;
      clearTimeout(timer);
      timer = setTimeout(() => void start(), pauseMs);
    },
    stop() {
      clearTimeout(timer);
      number = 0;
    },
  };
}

/** While the panel is open: request again whenever the design or the session changes. */
export function watchStability(): () => void {
  let lastInputsKey = "";
  const responseScheduler = createScheduler(RESPONSE_DELAY_MS, async () => {
    const now = currentResponse.peek() ?? (await requestResponse({}));
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
  const stop = effect(() => {
    if (draftKey.value === "null") return;
    if (inputsKey.value !== lastInputsKey) {
      lastInputsKey = inputsKey.value;
      currentResponse.value = null;
    }
    isStale.value = true;
    margins.value = null;
    responseScheduler.schedule();
    stabilityScheduler.schedule();
    marginsScheduler.schedule();
  });
  return () => {
    stop();
    responseScheduler.stop();
    stabilityScheduler.stop();
    marginsScheduler.stop();
  };
}
