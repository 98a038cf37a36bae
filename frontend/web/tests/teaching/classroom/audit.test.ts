import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { stubBrowser } from "../../browser";

const line = {
  time: "2026-01-02T03:04:05.678+00:00",
  person: "p-1",
  name: "Ada",
  role: "operator" as const,
  kind: "settings",
  did: "Set law",
  path: "/api/v1/sessions/lab/law",
  status: 200,
  refused: false,
  why: null,
  session: "lab",
  run_number: 1,
  tick: 1234,
};

const asked: URLSearchParams[] = [];
let answers: (() => Promise<Response>)[] = [];
const page = (total: number, until = "T") => ({
  lines: [line],
  total,
  until,
  people: [],
  kinds: [],
});
const answer = (body: unknown, status = 200) =>
  Promise.resolve(new Response(JSON.stringify(body), { status }));

async function load() {
  stubBrowser();
  vi.stubGlobal("fetch", (url: URL) => {
    asked.push(url.searchParams);
    return (answers.shift() ?? (() => answer(page(120))))();
  });
  return import("../../../src/teaching/classroom/audit");
}

beforeEach(() => {
  vi.resetModules();
  asked.length = 0;
  answers = [];
});
afterEach(() => vi.unstubAllGlobals());

describe("the audit log", () => {
  it("loads older pages of the log that the first page was read from", async () => {
    const log = await load();
    await log.queryAudit();
    await log.goToPage(2);
    expect(asked.map((query) => [query.get("page"), query.get("until")])).toEqual([
      ["1", ""],
      ["2", "T"],
    ]);
    expect(log.countPages(120)).toBe(3);
    expect(log.countPages(0)).toBe(1);
  });

  it("starts at the newest entry with another filter, and keeps the other filters", async () => {
    const log = await load();
    await log.queryAudit({ person: "p-1" });
    await log.goToPage(2);
    await log.queryAudit({ kind: "settings" });
    await log.queryAudit({ onlyRefused: true });
    const last = asked.at(-1) as URLSearchParams;
    expect(Object.fromEntries(last)).toEqual({
      person: "p-1",
      kind: "settings",
      refused: "true",
      page: "1",
      until: "",
    });
  });

  it("shows the latest request if an earlier answer arrives later", async () => {
    const log = await load();
    let late: (response: Response) => void = () => {};
    answers = [
      () =>
        new Promise((resolve) => {
          late = resolve;
        }),
      () => answer(page(7)),
    ];
    const first = log.queryAudit();
    await log.queryAudit({ kind: "settings" });
    late(await answer(page(99)));
    await first;
    expect(log.auditPage.value?.total).toBe(7);
    expect(log.isReading.value).toBe(false);
  });

  it("reports why it cannot be read, and keeps its entries", async () => {
    const log = await load();
    await log.queryAudit();
    answers = [() => answer({ detail: "Too much is being made.", violations: [] }, 503)];
    await log.queryAudit();
    expect(log.problem.value).toBe("Too much is being made.");
    expect(log.auditPage.value?.total).toBe(120);
  });
});

describe("a line of the audit log", () => {
  it("has the local time, with the date on another day", async () => {
    const { formatTime } = await load();
    const at = new Date(line.time);
    const clock = at.toLocaleTimeString("en-GB");
    expect(formatTime(line.time, at)).toBe(clock);
    const next = new Date(at.getTime() + 86_400_000);
    expect(formatTime(line.time, next)).toMatch(new RegExp(`^\\d+ Jan ${clock}$`));
  });

  it("shows the result, and the reason of failures and automatic actions", async () => {
    const { nameKind, describeResult: describeEnd } = await load();
    expect(describeEnd(line)).toBe("done");
    expect(describeEnd({ ...line, refused: true, status: 409 })).toBe("rejected (409)");
    expect(describeEnd({ ...line, status: null, why: "idle" })).toBe("idle");
    expect(describeEnd({ ...line, refused: true, status: null, why: "No key." })).toBe(
      "rejected: No key.",
    );
    expect(nameKind("settings")).toBe("Settings");
    expect(nameKind("toString")).toBe("toString");
  });
});
