/** The map of starts that come to rest, as it fills. */
import { computed, signal } from "@preact/signals";
import { askRegion, type Region, type StartOutcome } from "../../core/api/design";
import type { Law } from "../../core/api/types";
import { draft } from "./draft";
import { designRequest } from "./stability";

export type Slice = Region["chosen"];
export const STARTS = 31;
const PART = 48;

export const outcomes = signal<readonly StartOutcome[]>([]);
/** What the map is of: the answer that came first. */
export const shown = signal<Region | null>(null);
export const isFilling = signal(false);
export const problem = signal<unknown>(null);
const mapped = signal("");

const designOf = () => JSON.stringify(draft.value);
/** Whether the poles have been moved since. */
export const isOutdated = computed(() => shown.value !== null && mapped.value !== designOf());
export const share = computed(() => {
  const all = outcomes.value;
  return all.length === 0
    ? null
    : all.filter(({ outcome }) => outcome === "rest").length / all.length;
});

let filling = 0;

export function stopFilling(): void {
  filling++;
  isFilling.value = false;
}

/** Part by part, from coarse to fine, until it is full, stopped, or the poles are moved. */
export async function fillRegion(law: Law, chosen: Slice, stiffness: number): Promise<void> {
  const number = ++filling;
  const request = {
    ...designRequest(),
    law,
    chosen,
    stiffness_nm_per_rad: stiffness,
    starts: STARTS,
  };
  outcomes.value = [];
  shown.value = null;
  problem.value = null;
  mapped.value = designOf();
  isFilling.value = true;
  let first: number | null = 0;
  try {
    while (first !== null && number === filling && mapped.peek() === designOf()) {
      const part: Region = await askRegion({ ...request, first, count: PART });
      if (number !== filling) return;
      shown.value ??= part;
      outcomes.value = [...outcomes.peek(), ...part.outcomes];
      first = part.next;
    }
  } catch (error) {
    if (number === filling) problem.value = error;
  }
  if (number === filling) isFilling.value = false;
}
