/** The map of initial states from which the loop comes to rest, computed in parts. */
import { computed, signal } from "@preact/signals";
import { type Region, requestRegion, type StartOutcome } from "../../core/api/design";
import type { Law } from "../../core/api/types";
import { designRequest, draft } from "./draft";

export type Slice = Region["chosen"];
export const STARTS = 31;
const PART_SIZE = 48;

export const outcomes = signal<readonly StartOutcome[]>([]);
/** Design of the map, from its first answer. */
export const shownRegion = signal<Region | null>(null);
export const isComputing = signal(false);
export const problem = signal<unknown>(null);
const mappedDesign = signal("");

const designOf = () => JSON.stringify(draft.value);
/** Whether the poles have been moved since. */
export const isOutdated = computed(
  () => shownRegion.value !== null && mappedDesign.value !== designOf(),
);
export const restShare = computed(() => {
  const all = outcomes.value;
  return all.length === 0
    ? null
    : all.filter(({ outcome }) => outcome === "rest").length / all.length;
});

let fillNumber = 0;

export function stopComputing(): void {
  fillNumber++;
  isComputing.value = false;
}

/**
 * Compute part after part, from coarse to fine, until it is complete, stopped, or the poles are
 * moved.
 */
export async function computeRegion(law: Law, chosen: Slice, stiffness: number): Promise<void> {
  const number = ++fillNumber;
  const request = {
    ...designRequest(),
    law,
    chosen,
    stiffness_nm_per_rad: stiffness,
    starts: STARTS,
  };
  outcomes.value = [];
  shownRegion.value = null;
  problem.value = null;
  mappedDesign.value = designOf();
  isComputing.value = true;
  let first: number | null = 0;
  try {
    while (first !== null && number === fillNumber && mappedDesign.peek() === designOf()) {
      const part: Region = await requestRegion({ ...request, first, count: PART_SIZE });
      if (number !== fillNumber) return;
      shownRegion.value ??= part;
      outcomes.value = [...outcomes.peek(), ...part.outcomes];
      first = part.next;
    }
  } catch (error) {
    if (number === fillNumber) problem.value = error;
  }
  if (number === fillNumber) isComputing.value = false;
}
