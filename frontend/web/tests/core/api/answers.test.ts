import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { stubBrowser } from "../../browser";

const STATE = { run: 1, tick: 7, status: "running", time_s: 0.007, lanes: [{ id: 1 }] };
type Answer = { status: number; body: unknown } | "lost";
type Server = (method: string, path: string, name: string | null) => Answer;

const asked: string[] = [];

/** A browser with a scripted server; a lost call was executed or not, without a response. */
async function load(server: Server) {
  stubBrowser();
  vi.stubGlobal("fetch", async (url: URL, init: RequestInit) => {
    const path = url.pathname.replace("/api/v1/", "");
    asked.push(`${init.method} ${path}`);
    const name = (init.headers as Record<string, string>)["Idempotency-Key"] ?? null;
    const answer = server(String(init.method), path, name);
    if (answer === "lost") throw new TypeError("Failed to fetch");
    return new Response(JSON.stringify(answer.body), { status: answer.status });
  });
  const { start } = await import("../../../src/core/api/client");
  const { perform, problem } = await import("../../../src/core/state/actions");
  const { commandStatus } = await import("../../../src/core/api/outcome");
  const { session } = await import("../../../src/core/state/session");
  const { calls } = await import("../../../src/core/api/calls");
  const { t } = await import("../../../src/core/text/t");
  session.value = { ...STATE, tick: 0, status: "paused" } as never;
  return { press: () => perform("session", start), problem, commandStatus, session, calls, t };
}

const outcome = (outcome: string, status: number | null, known_for_s = 1e6): Answer => ({
  status: 200,
  body: { outcome, status, age_s: null, known_for_s },
});

beforeEach(() => {
  vi.resetModules();
  vi.useFakeTimers();
  asked.length = 0;
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("a command whose answer was lost", () => {
  it("is queried by its key, and reported as executed with the state that it returned", async () => {
    let sent: string | null = null;
    let isUp = false;
    const page = await load((method, path, name) => {
      if (method === "POST") {
        sent = name;
        return "lost";
      }
      if (!isUp) return "lost";
      if (path === `requests/${sent}`) return outcome("carried_out", 200);
      return { status: 200, body: STATE };
    });
    const pressed = page.press();
    await vi.advanceTimersByTimeAsync(2000);
    expect(page.commandStatus.value, "not known yet").toBe("asking");
    expect(page.problem.value).toBeNull();
    isUp = true;
    await vi.advanceTimersByTimeAsync(1000);
    expect(await pressed).toBe(true);
    expect(page.commandStatus.value).toBe("carriedOut");
    expect(page.session.value?.status).toBe("running");
    expect(page.problem.value).toBeNull();
    expect(page.calls.value.map((call) => call.status)).toEqual([200]);
    expect(
      asked.filter((each) => each.startsWith("POST")),
      "never sent again",
    ).toHaveLength(1);
    await vi.advanceTimersByTimeAsync(10_000);
    expect(page.commandStatus.value).toBeNull();
  });

  it("is reported as not executed only if the server reports twice that it never arrived", async () => {
    const page = await load((method) => (method === "POST" ? "lost" : outcome("unknown", null)));
    const pressed = page.press();
    await vi.advanceTimersByTimeAsync(100);
    expect(page.problem.value).toBeNull();
    await vi.advanceTimersByTimeAsync(2000);
    expect(await pressed).toBe(false);
    expect(page.problem.value?.message).toBe(page.t("connection.notCarriedOut"));
    expect(page.commandStatus.value).toBeNull();
    expect(page.calls.value.map((call) => call.status)).toEqual([null]);
  });

  it("is reported as rejected if the server rejected it", async () => {
    const page = await load((method) => (method === "POST" ? "lost" : outcome("refused", 409)));
    const pressed = page.press();
    await vi.advanceTimersByTimeAsync(1000);
    expect(await pressed).toBe(false);
    expect(page.problem.value?.message).toBe(page.t("connection.refused", { status: 409 }));
  });

  it("stays unknown with a server that began later, or that does not answer for a minute", async () => {
    const answers: Answer[] = [outcome("unknown", null, 0), outcome("pending", null), "lost"];
    for (const answer of answers) {
      vi.resetModules();
      const page = await load((method) => (method === "POST" ? "lost" : answer));
      const pressed = page.press();
      await vi.advanceTimersByTimeAsync(70_000);
      expect(await pressed).toBe(false);
      expect(page.problem.value?.message).toBe(page.t("connection.stillUnknown"));
      expect(page.commandStatus.value).toBeNull();
    }
  });
});

describe("a change of a run whose answer was lost", () => {
  it("is reported as executed if it was, and is not repeated", async () => {
    const page = await load((method) =>
      method === "PATCH" ? "lost" : outcome("carried_out", 200),
    );
    const { changeRun } = await import("../../../src/core/api/runs");
    const { attempt, runsProblem } = await import("../../../src/runs/list/problem");
    expect(await attempt(() => changeRun({ id: "a", revision: "1" }, { name: "A" }))).toBeNull();
    expect(runsProblem.value).toBe(page.t("connection.doneUnseen"));
    expect(asked.filter((each) => each.startsWith("PATCH"))).toHaveLength(1);
  });

  it("sends no query for a lost read", async () => {
    const page = await load(() => "lost");
    const { readRun } = await import("../../../src/core/api/runs");
    const { attempt, runsProblem } = await import("../../../src/runs/list/problem");
    expect(await attempt(() => readRun("a"))).toBeNull();
    expect(runsProblem.value).toBe(page.t("connection.unreachable"));
    expect(asked).toHaveLength(1);
  });
});

describe("a received answer", () => {
  it("is accepted, or its rejection is reported, without a query", async () => {
    const page = await load(() => ({ status: 200, body: STATE }));
    expect(await page.press()).toBe(true);
    expect(asked).toEqual(["POST sessions/lab/start"]);
    vi.resetModules();
    const refusing = await load(() => ({
      status: 409,
      body: { type: "urn:svsa:problem:not_now", detail: "Arm it first.", violations: [] },
    }));
    expect(await refusing.press()).toBe(false);
    expect(refusing.problem.value?.message).toBe("Arm it first.");
    expect(refusing.commandStatus.value).toBeNull();
  });
});
