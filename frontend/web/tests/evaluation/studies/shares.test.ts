import { effect } from "@preact/signals";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { stubBrowser } from "../../browser";

const asked: string[] = [];
let isDown = false;

async function load() {
  stubBrowser();
  vi.stubGlobal("fetch", async (url: URL) => {
    asked.push(url.search);
    if (isDown) return new Response(JSON.stringify({ detail: "busy" }), { status: 503 });
    const found = url.searchParams.getAll("counts").map((pair) => {
      const [count, others] = pair.split(",").map(Number) as [number, number];
      return { value: count / (count + others), low: 0.1, high: 0.9 };
    });
    return new Response(JSON.stringify(found));
  });
  return import("../../../src/evaluation/studies/shares");
}

beforeEach(() => {
  vi.resetModules();
  asked.length = 0;
  isDown = false;
});
afterEach(() => vi.unstubAllGlobals());

it("shares that are shown together are requested together, and each once", async () => {
  const { shareOf } = await load();
  const seen: unknown[] = [];
  const stop = effect(() => {
    seen.push([shareOf(8, 10)?.value, shareOf(0, 81)?.value, shareOf(8, 10)?.high]);
  });
  expect(seen).toEqual([[undefined, undefined, undefined]]);
  await vi.waitFor(() => expect(seen.at(-1)).toEqual([0.8, 0, 0.9]));
  expect(shareOf(8, 10)).toEqual({ value: 0.8, low: 0.1, high: 0.9 });
  expect(asked.map(decodeURIComponent)).toEqual(["?counts=8,2&counts=0,81"]);
  stop();
});

it("many shares are requested in parts that fit into an address", async () => {
  const { shareOf } = await load();
  for (let count = 0; count < 450; count++) shareOf(count, 1000);
  await vi.waitFor(() => expect(shareOf(449, 1000)).not.toBeNull());
  expect(asked.map((query) => query.split("counts=").length - 1)).toEqual([200, 200, 50]);
});

it("a share that failed is requested again when it is shown again", async () => {
  const { shareOf } = await load();
  isDown = true;
  shareOf(1, 2);
  await vi.waitFor(() => expect(asked.length).toBe(1));
  isDown = false;
  await vi.waitFor(() => expect(shareOf(1, 2)).toEqual({ value: 0.5, low: 0.1, high: 0.9 }), 5000);
});
