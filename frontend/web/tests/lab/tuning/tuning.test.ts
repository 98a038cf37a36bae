import "../../browserless";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { Candidate, Tuning } from "../../../src/core/api/jobs";

const {
  applyBest,
  bestSoFar,
  candidates,
  isTuning: isUnderWay,
  problem,
  start,
  tuning,
} = await import("../../../src/lab/tuning/tuning");

const trial = (number: number, cost: number): Candidate => ({
  number,
  stage: number === 0 ? "present" : "search",
  values: [40],
  cost,
  torque_variation_nm_per_s: 100,
  held: 1,
  trials: 1,
  position_error_deg: 1,
  stiffness_error_percent: 1,
});

const state = (
  status: Tuning["status"],
  tried: Candidate[],
  more: Partial<Tuning> = {},
): Tuning => ({
  id: "abc",
  kind: "tuning",
  title: "FL + I",
  created: "2026-01-02T03:04:05+00:00",
  done: tried.length,
  total: 4,
  rate_per_s: null,
  left_s: null,
  result: null,
  law: "fl_integral",
  status,
  budget: 3,
  seed: 0,
  held: {},
  axes: [],
  noise_limit_nm_per_s: 295,
  finals: [],
  tried: tried.length,
  candidates: tried,
  present: null,
  best: null,
  best_setting: null,
  problem: null,
  ...more,
});

/** A job as the server sends it, with the tuning's result. */
const sent = ({ id, status, problem: why, ...result }: Tuning) => ({
  id,
  status,
  problem: why,
  result,
});

type Call = { method: string; path: string; body: unknown };
let calls: Call[] = [];
let answers: (unknown | "lost")[] = [];

beforeEach(() => {
  vi.useFakeTimers();
  calls = [];
  answers = [];
  tuning.value = null;
  candidates.value = [];
  problem.value = "";
  vi.stubGlobal("fetch", async (url: URL, init: RequestInit) => {
    const path = `${url.pathname.split("/api/v1/")[1]}${url.search}`;
    const body = typeof init.body === "string" ? JSON.parse(init.body) : null;
    calls.push({ method: init.method ?? "", path, body });
    if (init.method === "PUT") return Response.json({ run: 1, tick: 1, lanes: [] });
    const answer = answers.shift();
    if (answer === "lost") throw new TypeError("Failed to fetch");
    return Response.json(answer);
  });
});

afterEach(() => vi.useRealTimers());

describe("a running tuning", () => {
  it("requests the missing candidates, also after a lost answer, until it ends", async () => {
    answers = [
      sent(state("waiting", [])),
      sent(state("running", [trial(0, 3), trial(1, 2)])),
      "lost",
      sent(state("done", [trial(2, 1), trial(3, 4)], { tried: 4 })),
    ];
    const body = { kind: "tuning", law: "fl_integral", budget: 3, session: "lab" };
    await start(body);
    expect(calls[0]).toEqual({ method: "POST", path: "jobs", body });
    expect(isUnderWay.value).toBe(true);
    await vi.advanceTimersByTimeAsync(1000);
    expect(problem.value).not.toBe("");
    await vi.advanceTimersByTimeAsync(5000);
    expect(calls.slice(1).map(({ path }) => path)).toEqual([
      "jobs/abc?first=0",
      "jobs/abc?first=2",
      "jobs/abc?first=2",
    ]);
    expect(candidates.value.map(({ number }) => number)).toEqual([0, 1, 2, 3]);
    expect([isUnderWay.value, problem.value]).toEqual([false, ""]);
  });

  it("does not start if the server rejects it, and the previous one is kept", async () => {
    tuning.value = state("done", []);
    vi.stubGlobal("fetch", async () =>
      Response.json({ type: "urn:svsa:problem:busy", detail: "too much" }, { status: 503 }),
    );
    await expect(start({})).rejects.toThrow("too much");
    expect(tuning.value?.status).toBe("done");
  });
});

describe("the result of a tuning", () => {
  it("is the lowest cost so far, after every candidate", () => {
    expect(bestSoFar([trial(0, 3), trial(1, 5), trial(2, 1), trial(3, 2)])).toEqual([
      [0, 3],
      [1, 3],
      [2, 1],
      [3, 1],
    ]);
  });

  it("is applied to the session as parameters of its law, or as gains and the observer", async () => {
    const parameters = { position_pole_rad_per_s: 41 };
    const own = { law: "fl_integral", gains: null, parameters, observer: null };
    tuning.value = state("done", [], { best_setting: own as never });
    await applyBest();
    const gains = { position_coefficients: [1, 2, 3, 4], stiffness_coefficients: [5, 6] };
    const observer = { bandwidth_rad_per_s: [44, 44, 44] };
    const shared = { law: "ndobc", gains, parameters: null, observer };
    tuning.value = state("done", [], { law: "ndobc", best_setting: shared as never });
    await applyBest();
    const session = "sessions/lab";
    expect(calls.map(({ method, path, body }) => [method, path, body])).toEqual([
      ["PUT", `${session}/parameters`, { fl_integral: parameters }],
      ["PUT", `${session}/gains`, gains],
      ["PUT", `${session}/observer`, observer],
    ]);
  });
});
