/** What is asked of the server about the stability of the design that is tried. */
import { computed, effect, signal } from "@preact/signals";
import {
  askMargins,
  askResponse,
  askStability,
  type DesignRequest,
  type DesignResponse,
  type Margins,
  type Stability,
} from "../../core/api/design";
import { session } from "../../core/state/session";
import { draft, isChanged, requestOf, surroundings } from "./draft";

export const tried = signal<DesignResponse | null>(null);
export const present = signal<DesignResponse | null>(null);
export const stability = signal<Stability | null>(null);
export const margins = signal<Margins | null>(null);
/** Whether what is shown is of other gains than those that stand in the plane. */
export const isStale = signal(false);

const QUICK_PAUSE_MS = 120;
const LONG_PAUSE_MS = 450;
const RETRY_MS = 2500;

/** Everything that the answers depend on: changes only if a value changes. */
const question = computed(() => {
  const configuration = session.value?.configuration;
  return JSON.stringify([configuration?.actuator, configuration?.nominal, surroundings.value]);
});
const wanted = computed(() => JSON.stringify(draft.value));

/** The request for the design in the plane; for what is in use nothing is sent along. */
export function designRequest(): DesignRequest {
  const tried = draft.peek();
  return tried !== null && isChanged.peek() ? requestOf(tried) : {};
}

/** Asks after a pause; one question at a time, the last one counts, and it is asked again if refused. */
function asker(pauseMs: number, ask: () => Promise<() => void>): { soon(): void; stop(): void } {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let isBusy = false;
  let number = 0;
  const start = async () => {
    if (isBusy) return;
    isBusy = true;
    const asked = number;
    let isDone = false;
    try {
      const take = await ask();
      isDone = true;
      if (asked === number) take();
    } catch {
      if (asked === number) timer = setTimeout(() => void start(), RETRY_MS);
    }
    isBusy = false;
    if (isDone && asked !== number && number > 0) void start();
  };
  return {
    soon() {
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

/** While the panel is open: asks again whenever the design or the session changes. */
export function watchStability(): () => void {
  let seen = "";
  const quick = asker(QUICK_PAUSE_MS, async () => {
    const now = present.peek() ?? (await askResponse({}));
    const found = isChanged.peek() ? await askResponse(designRequest()) : now;
    return () => {
      present.value = now;
      tried.value = found;
    };
  });
  const long = asker(LONG_PAUSE_MS, async () => {
    const found = await askStability(designRequest());
    return () => {
      stability.value = found;
      isStale.value = false;
    };
  });
  const longer = asker(LONG_PAUSE_MS, async () => {
    const found = await askMargins(designRequest());
    return () => {
      margins.value = found;
    };
  });
  const stop = effect(() => {
    if (wanted.value === "null") return;
    if (question.value !== seen) {
      seen = question.value;
      present.value = null;
    }
    isStale.value = true;
    margins.value = null;
    quick.soon();
    long.soon();
    longer.soon();
  });
  return () => {
    stop();
    quick.stop();
    long.stop();
    longer.stop();
  };
}
