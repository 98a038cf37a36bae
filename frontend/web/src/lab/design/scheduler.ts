/** Requests that follow changes of the design and of the session. */
import { effect, type ReadonlySignal } from "@preact/signals";
import { draftKey } from "./draft";

const RETRY_MS = 2500;

type Scheduler = ReturnType<typeof createScheduler>;

/**
 * Request after a pause; one request at a time, the last one counts; repeated after a rejection.
 */
export function createScheduler(pauseMs: number, request: () => Promise<() => void>) {
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

/**
 * Schedule requests whenever the design or the inputs change. prepare: called before; areNew:
 * whether the inputs have changed. Returns the function that ends it.
 */
export function watchDesign(
  inputs: ReadonlySignal<string>,
  prepare: (areNew: boolean) => void,
  schedulers: readonly Scheduler[],
): () => void {
  let last = "";
  const stop = effect(() => {
    if (draftKey.value === "null") return;
    const areNew = inputs.value !== last;
    last = inputs.value;
    prepare(areNew);
    for (const scheduler of schedulers) scheduler.schedule();
  });
  return () => {
    stop();
    for (const scheduler of schedulers) scheduler.stop();
  };
}
