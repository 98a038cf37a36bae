/** Shares of counted runs with their intervals, estimated by the server. */
import { signal } from "@preact/signals";
import { type Estimate, estimateShares } from "../../core/api/studies";

const BATCH_SIZE = 200;
const PAUSE_MS = 1000;

/** By `count/total`, on which alone an estimate depends; each is requested once. */
const estimates = signal<ReadonlyMap<string, Estimate>>(new Map());
const pending = new Map<string, readonly [number, number]>();
let isRequesting = false;

/** The pending counts, requested in batches; after a failure once more. */
async function requestPending(): Promise<void> {
  while (pending.size > 0) {
    const batch = [...pending].slice(0, BATCH_SIZE);
    try {
      const newEstimates = await estimateShares(batch.map(([, counts]) => counts));
      const pairs = batch.map(([key], at) => [key, newEstimates[at] as Estimate] as const);
      for (const [key] of batch) pending.delete(key);
      estimates.value = new Map([...estimates.peek(), ...pairs]);
    } catch {
      pending.clear(); // counts that are still shown are requested again after the next change
      await new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
    }
  }
}

/**
 * The estimate of a share; null until the server has sent it, which redraws its readers.
 *
 * count: number of successful runs. total: number of runs.
 */
export function shareOf(count: number, total: number): Estimate | null {
  const key = `${count}/${total}`;
  const estimate = estimates.value.get(key);
  if (estimate !== undefined) return estimate;
  pending.set(key, [count, total]);
  if (!isRequesting) {
    isRequesting = true;
    queueMicrotask(() =>
      requestPending().finally(() => {
        isRequesting = false;
      }),
    );
  }
  return null;
}
