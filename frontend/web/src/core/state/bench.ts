/** The bench of the session, and what stands for it on every screen. */
import { computed } from "@preact/signals";
import { type Mark, markOfBench } from "./plant";
import { session } from "./session";

export const bench = computed(() => session.value?.bench ?? null);

/** Null for a simulation, which needs no mark. */
export const mark = computed<Mark | null>(() => {
  if (bench.value === null) return null;
  return markOfBench(bench.value);
});
