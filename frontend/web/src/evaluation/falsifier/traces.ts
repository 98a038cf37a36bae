/** The outcomes of laws in the selected scenario. */
import { computed, signal } from "@preact/signals";
import { type Scenario, type Trace, traceLaws } from "../../core/api/falsifications";
import type { Law } from "../../core/api/types";
import { isObserver } from "../../core/state/access";
import { attempt, laws, scenario, selectionKey } from "./falsifier";

/** The outcomes of the laws, with their scenario, laws and place. */
export const lastTrace = signal<{ at: string; key: string; trace: Trace } | null>(null);

/** The outcomes of the laws in the selected scenario, of the latest request. */
export const shownTrace = computed(() =>
  lastTrace.value?.at === selectionKey.value ? lastTrace.value.trace : null,
);

export const keyOf = (shown: Scenario, names: readonly Law[]): string =>
  JSON.stringify([shown.loads, shown.settings, shown.base, shown.duration_s, names]);

let isTracing = false;

/** Run the laws in the selected scenario; later requests are queued. */
export async function traceSelection(): Promise<void> {
  if (isTracing || isObserver.peek()) return;
  isTracing = true;
  try {
    for (;;) {
      const [shown, names, here] = [scenario.peek(), laws.peek(), selectionKey.peek()];
      if (shown === null) return;
      const key = keyOf(shown, names);
      const last = lastTrace.peek();
      if (last?.key === key && last.at === here) return;
      const traces = await attempt(() => traceLaws(shown, names));
      if (here !== selectionKey.peek()) continue;
      if (traces === null) return;
      lastTrace.value = { at: here, key, trace: traces };
    }
  } finally {
    isTracing = false;
  }
}
