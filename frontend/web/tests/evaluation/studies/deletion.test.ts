import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { stubBrowser } from "../../browser";

const asked: string[] = [];
let refusal: string | null = null;

async function load() {
  stubBrowser();
  vi.stubGlobal("history", { pushState: () => {}, replaceState: () => {} });
  vi.stubGlobal("location", { search: "?studies=mine", href: "http://lab/?studies=mine" });
  vi.stubGlobal("fetch", async (url: URL, { method }: RequestInit) => {
    asked.push(`${method} ${url.pathname.replace("/api/v1/", "")}`);
    if (method === "DELETE" && refusal !== null) {
      return new Response(JSON.stringify({ detail: refusal, violations: [] }), { status: 409 });
    }
    if (method === "DELETE") return new Response(null, { status: 204 });
    return new Response(JSON.stringify({ built_in: [], saved: [], metrics: [] }));
  });
  const selection = await import("../../../src/evaluation/studies/selection");
  return { ...selection, ...(await import("../../../src/evaluation/studies/studies")) };
}

beforeEach(() => {
  vi.resetModules();
  asked.length = 0;
  refusal = null;
});
afterEach(() => vi.unstubAllGlobals());

it("a deleted study is closed, and the list is reloaded", async () => {
  const studies = await load();
  expect(studies.chosenName.value).toBe("mine");
  expect(await studies.remove("mine")).toBe(true);
  expect(asked).toEqual(["DELETE studies/mine", "GET studies"]);
  expect(studies.chosenName.value).toBe("");
  expect(studies.isBusy.value).toBe("");
});

it("without a name in the address the newest study or the example is shown", async () => {
  const studies = await load();
  const { place } = await import("../../../src/runs/list/place");
  place.value = { kind: "studies", study: "", look: {} };
  expect(studies.chosenName.value).toBe("");
  studies.list.value = { built_in: [], saved: [{ name: "example" }], metrics: [] } as never;
  expect(studies.chosenName.value).toBe("example");
  studies.setView({ law: "fl" });
  expect(place.value).toMatchObject({ study: "example", look: { law: "fl" } });
});

it("a study whose deletion fails stays open, with the reason", async () => {
  const studies = await load();
  refusal = "Study mine is being run by another process.";
  expect(await studies.remove("mine")).toBe(false);
  expect(studies.problem.value).toBe(refusal);
  expect(studies.chosenName.value).toBe("mine");
});
