import "../../browserless";
import { beforeEach, describe, expect, test, vi } from "vitest";
import type { BoardEntry } from "../../../src/core/api/ranking";

const { COLUMNS, sortEntries } = await import("../../../src/teaching/leaderboard/columns");
const {
  board,
  entries,
  hasSubmittedEntry: isEntered,
  job,
  unfollow: leave,
  shownEntry: looked,
  existingEntryKey: note,
  openBoard,
  problem,
  sort,
  submit,
  submittedKey: submitted,
} = await import("../../../src/teaching/leaderboard/leaderboard");
const { place, readPlace, writePlace } = await import("../../../src/runs/list/place");
const { atMoment } = await import("../../../src/core/api/runs");

const entryOf = (
  key: string,
  rank: number,
  score: number,
  more: { rms?: number | null; author?: string; tick?: number | null; lab?: boolean } = {},
): BoardEntry =>
  ({
    key,
    rank,
    name: key.toUpperCase(),
    author: more.author ?? "",
    is_installed: more.lab ?? false,
    entered: "2026-01-02T03:04:05+00:00",
    standing: {
      success: score,
      trials_ended: Math.round(10 * (1 - score)),
      median_rms_deg: 1 - score,
      tick_us: more.tick === undefined ? 20 : more.tick,
      worst: { rms_deg: more.rms === undefined ? 1 : more.rms },
    },
  }) as unknown as BoardEntry;

const ENTRIES = [
  entryOf("a", 1, 0.9, { rms: 2, author: "Zuse" }),
  entryOf("b", 2, 0.7, { rms: null, author: "Ada" }),
  entryOf("c", 2, 0.7, { rms: 0.5, tick: null, lab: true }),
  entryOf("d", 4, 0.2, { rms: 9 }),
];

describe("the order of the entries", () => {
  const orderBy = (key: string, isDown: boolean) =>
    sortEntries(ENTRIES, key, isDown)
      .map(({ key: name }) => name)
      .join("");

  test("a run that ended early is worse than any error, and a missing value is last", () => {
    expect(orderBy("worst", false)).toBe("cadb");
    expect(orderBy("worst", true)).toBe("bdac");
    expect(orderBy("cost", false)).toBe("abdc");
    expect(orderBy("cost", true)).toBe("abdc");
  });

  test("every column is sorted in both directions", () => {
    for (const { key } of COLUMNS) {
      expect([...orderBy(key, false)].sort().join("")).toBe("abcd");
      expect([...orderBy(key, true)].sort().join("")).toBe("abcd");
    }
    expect(orderBy("success", true)).toBe("abcd");
    expect(orderBy("success", false)).toBe("dbca");
  });
});

describe("the address of the leaderboard", () => {
  test("names the board, or the entry whose worst run is shown", () => {
    expect(readPlace("?leaderboard=all")).toEqual({ kind: "leaderboard", entry: "" });
    expect(readPlace("?leaderboard=fl")).toEqual({ kind: "leaderboard", entry: "fl" });
    expect(writePlace({ kind: "leaderboard", entry: "" }, "?ranking=all")).toBe("?leaderboard=all");
    expect(writePlace({ kind: "leaderboard", entry: "fl" }, "")).toBe("?leaderboard=fl");
    expect(writePlace({ kind: "lab" }, "?leaderboard=fl&session=x")).toBe("?session=x");
  });

  test("opens a replay at a time", () => {
    expect(atMoment("http://lab/replay", 0)).toBe("http://lab/replay");
    expect(atMoment("http://lab/replay", 5.5)).toBe("http://lab/replay?t=5.5");
  });
});

describe("the actions of the page", () => {
  const season = { suite: "1", began: "", not_isolated: null, runs: 3, missing: [] };
  const asked: string[] = [];
  let answers: Record<string, unknown[]> = {};

  beforeEach(() => {
    vi.useFakeTimers();
    leave();
    asked.length = 0;
    [board.value, job.value, note.value, submitted.value] = [null, null, "", ""];
    vi.stubGlobal("fetch", async (address: URL, { method }: { method: string }) => {
      const path = `${method} ${address.pathname.replace("/api/v1/", "")}`;
      asked.push(path);
      const [next, ...rest] = answers[path] ?? [];
      if (rest.length > 0) answers[path] = rest;
      if (next === undefined) throw new Error(`unexpected ${path}`);
      const refused = (next as { refused?: string }).refused;
      const body = refused ? { detail: refused, violations: [] } : next;
      return { ok: !refused, status: refused ? 409 : 200, text: async () => JSON.stringify(body) };
    });
  });

  const jobOf = (status: string, done: number, why: string | null = null) => ({
    id: "j",
    kind: "submission",
    title: "Mine",
    status,
    done,
    total: 3,
    problem: why,
  });
  const wish = { name: "Mine", author: "", law: "def law(*given): return 0, 0" };

  test("a submission is followed until it ends, and its entry is on the board", async () => {
    answers = {
      "POST leaderboard/submissions": [{ key: "b", job: jobOf("waiting", 0) }],
      "GET jobs/j": [jobOf("running", 1), jobOf("done", 3)],
      "GET leaderboard": [{ ...season, entries: ENTRIES }],
    };
    const sent = submit(wish);
    await vi.runAllTimersAsync();
    expect(await sent).toBe(true);
    expect(job.value?.status).toBe("done");
    expect(submitted.value).toBe("b");
    expect(entries.value.map(({ key }) => key)).toEqual(["a", "b", "c", "d"]);
    sort.value = "-rank";
    expect(entries.value[0]?.key).toBe("d");
    sort.value = "rank";
  });

  test("the entry of a law is listed while the laws of the lab are measured after it", async () => {
    board.value = { ...season, entries: [] };
    const going = { ...jobOf("running", 3), title: "B" };
    answers = {
      "POST leaderboard/submissions": [{ key: "b", job: going }],
      "GET jobs/j": [
        going,
        { ...going, done: 4, total: 9 },
        { ...going, status: "done", done: 9, total: 9 },
      ],
      "GET leaderboard": [{ ...season, entries: ENTRIES }],
    };
    const sent = submit(wish);
    await vi.advanceTimersByTimeAsync(100);
    expect([entries.value.length, isEntered.value]).toEqual([0, false]);
    await vi.advanceTimersByTimeAsync(700);
    expect([entries.value.length, isEntered.value]).toEqual([4, true]);
    await vi.runAllTimersAsync();
    await sent;
    expect(isEntered.value).toBe(false);
  });

  test("the reason of a failed law stays with its job", async () => {
    answers = {
      "POST leaderboard/submissions": [{ key: "x", job: jobOf("running", 0) }],
      "GET jobs/j": [jobOf("failed", 0, "line 2: NameError")],
      "GET leaderboard": [{ ...season, entries: [] }],
    };
    const sent = submit(wish);
    await vi.runAllTimersAsync();
    await sent;
    expect(job.value?.problem).toBe("line 2: NameError");
  });

  test("a text that already has an entry is reported, and no job is followed", async () => {
    answers = {
      "POST leaderboard/submissions": [{ key: "b", job: null }],
      "GET leaderboard": [{ ...season, entries: ENTRIES }],
    };
    await submit(wish);
    expect(note.value).toBe("b");
    expect(asked).toEqual(["POST leaderboard/submissions", "GET leaderboard"]);
  });

  test("a rejection by the lab is shown", async () => {
    answers = { "POST leaderboard/submissions": [{ refused: "it cannot be isolated" }] };
    expect(await submit(wish)).toBe(false);
    expect(problem.value).toContain("it cannot be isolated");
  });

  test("after a reload a running submission is followed again, and a discarded one is not", async () => {
    answers = {
      "GET leaderboard": [{ ...season, entries: ENTRIES }],
      "GET jobs": [
        { jobs: [{ ...jobOf("running", 0), kind: "study", id: "s" }, jobOf("running", 1)] },
      ],
      "GET jobs/j": [jobOf("running", 2), jobOf("cancelled", 2)],
    };
    const opened = openBoard();
    await vi.advanceTimersByTimeAsync(100);
    expect(job.value?.done).toBe(2);
    leave();
    await vi.runAllTimersAsync();
    await opened;
    expect(job.value?.status).toBe("running");
  });

  test("an entry of another season is ignored", () => {
    board.value = { ...season, entries: ENTRIES };
    place.value = { kind: "leaderboard", entry: "c" };
    expect(looked.value?.key).toBe("c");
    place.value = { kind: "leaderboard", entry: "gone" };
    expect(looked.value).toBeUndefined();
  });
});
