/** Shares of counted runs with their intervals, which the server estimates. */
import { signal } from "@preact/signals";
import { type Estimate, estimateShares } from "../../core/api/studies";

const AT_ONCE = 200;
const PAUSE_MS = 1000;

/** By `count/total`: an estimate depends on nothing else, and is asked for once. */
const known = signal<ReadonlyMap<string, Estimate>>(new Map());
const wanted = new Map<string, readonly [number, number]>();
let isAsking = false;

/** The counts that are wanted, some at a time, until each is known; after a failure once more. */
async function askForWanted(): Promise<void> {
  while (wanted.size > 0) {
    const batch = [...wanted].slice(0, AT_ONCE);
    try {
      const found = await estimateShares(batch.map(([, counts]) => counts));
      const pairs = batch.map(([key], at) => [key, found[at] as Estimate] as const);
      for (const [key] of batch) wanted.delete(key);
      known.value = new Map([...known.peek(), ...pairs]);
    } catch {
      wanted.clear(); // those still shown are asked for again with the next change
      await new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
    }
  }
}

/**
 * The estimate of a share; null until the server has sent it, which draws what reads it again.
 *
 * count: how many of them succeeded. total: how many runs there are.
 */
export function shareOf(count: number, total: number): Estimate | null {
  const key = `${count}/${total}`;
  const found = known.value.get(key);
  if (found !== undefined) return found;
  wanted.set(key, [count, total]);
  if (!isAsking) {
    isAsking = true;
    queueMicrotask(() =>
      askForWanted().finally(() => {
        isAsking = false;
      }),
    );
  }
  return null;
}
