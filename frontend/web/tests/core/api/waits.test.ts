import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { stubBrowser } from "../../browser";

const SLOW_MS = 20_000;
const waits: number[] = [];

beforeEach(() => {
  waits.length = 0;
  vi.spyOn(AbortSignal, "timeout").mockImplementation((waitMs) => {
    waits.push(waitMs);
    return new AbortController().signal;
  });
  stubBrowser();
  vi.stubGlobal("fetch", async () => new Response("{}"));
});

afterEach(() => {
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
});

it("waits for a slow lab during login, since a repeated login would create a second user", async () => {
  const { rejoin: comeBack, join, login } = await import("../../../src/core/api/access");
  await Promise.all([join("Ada", "ABCD-EFGH"), comeBack("IJKL"), login("secret")]);
  expect(waits).toHaveLength(3);
  expect(Math.min(...waits)).toBeGreaterThan(SLOW_MS);
  const { calls } = await import("../../../src/core/api/calls");
  expect(calls.value, "secrets are not shown").toEqual([]);
});

it("waits for a prediction until its worker has started, and requests it once", async () => {
  const { requestResponse, predict } = await import("../../../src/core/api/design");
  await Promise.all([predict({}), requestResponse({} as never)]);
  expect(waits).toHaveLength(2);
  expect(Math.min(...waits)).toBeGreaterThan(SLOW_MS);
});
