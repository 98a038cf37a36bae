import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { stubBrowser } from "../../browser";

const saved: string[] = [];

beforeEach(() => {
  vi.resetModules();
  saved.length = 0;
});
afterEach(() => vi.unstubAllGlobals());

async function load(answer: () => Promise<Response>) {
  stubBrowser();
  vi.stubGlobal("fetch", answer);
  vi.stubGlobal("location", new URL("http://lab.test/"));
  URL.createObjectURL = () => "blob:replay";
  URL.revokeObjectURL = () => undefined;
  const link = { href: "", download: "", click: () => void saved.push(link.download) };
  vi.stubGlobal("document", { baseURI: "http://lab.test/", createElement: () => link });
  return import("../../../src/runs/list/problem");
}

describe("a file that takes the server long", () => {
  it("is shown as in progress, requested once, and saved under its name", async () => {
    let answer: (response: Response) => void = () => undefined;
    let asked = 0;
    const { exportFile: makeFile, fileExport: making } = await load(() => {
      asked += 1;
      return new Promise((resolve) => {
        answer = resolve;
      });
    });
    const first = makeFile("a run", "runs/a/export?kind=html");
    expect(making.value).toMatchObject({ run: "a run", stage: "making" });
    await makeFile("another", "runs/b/export?kind=html");
    expect([asked, making.value?.run]).toEqual([1, "a run"]);
    const headers = { "Content-Disposition": 'attachment; filename="fig-4a.html"' };
    answer(new Response("<html>", { headers }));
    await first;
    expect(saved).toEqual(["fig-4a.html"]);
    expect(making.value?.stage).toBe("saved");
  });

  it("reports why it failed", async () => {
    const refusal = JSON.stringify({ detail: "Another replay is being made: ask again in 5 s." });
    const { exportFile: makeFile, fileExport: making } = await load(
      async () => new Response(refusal, { status: 503 }),
    );
    await makeFile("a run", "runs/a/export?kind=html");
    expect(saved).toEqual([]);
    expect(making.value).toMatchObject({ stage: "failed" });
    expect(making.value?.message).toContain("ask again in 5 s");
  });
});
