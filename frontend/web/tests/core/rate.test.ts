import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { limitRate } from "../../src/core/rate";

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

it("calls at once, then once per period, and makes the last call", () => {
  const calls: number[] = [];
  let value = 0;
  const { request } = limitRate(
    () => calls.push(value),
    () => 100,
  );
  for (value = 1; value <= 5; value++) {
    request();
    vi.advanceTimersByTime(30);
  }
  expect(calls).toEqual([1, 4]);
  vi.advanceTimersByTime(1000);
  expect(calls).toEqual([1, 4, 6]);
  request();
  expect(calls).toEqual([1, 4, 6, 6]);
});

it("makes no call after its end", () => {
  const run = vi.fn();
  const { request, cancel } = limitRate(run, () => 100);
  request();
  request();
  cancel();
  vi.advanceTimersByTime(1000);
  expect(run).toHaveBeenCalledTimes(1);
});
