import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { SessionRequest } from "../../../src/core/api/client";
import { stubBrowser } from "../../browser";

type Sine = { kind: "sine"; amplitude_rad: number; frequency_hz: number };
const SINE: Sine = { kind: "sine", amplitude_rad: 1, frequency_hz: 0.2 };
const stateAt = (revision: string, position: Sine = SINE, law = "ndobc") => ({
  run_number: 1,
  tick: 7,
  revision,
  lanes: [],
  configuration: { position, law, comparisons: [] },
});
type State = ReturnType<typeof stateAt>;

/** A server that accepts a setting only with its present revision. */
class Server {
  held = stateAt("1.0");
  readonly asked: string[] = [];

  change(position: Partial<Sine>, law = this.held.configuration.law): void {
    const [run, count] = this.held.revision.split(".");
    const now = { ...this.held.configuration.position, ...position };
    this.held = stateAt(`${run}.${Number(count) + 1}`, now, law);
  }

  answer(method: string, path: string, match: string | null, body: unknown): [number, unknown] {
    this.asked.push(`${method} ${path.replace("sessions/lab", "")} ${match ?? "-"}`);
    if (method === "GET") return [200, this.held];
    if (match !== null && match !== `"${this.held.revision}"`) {
      return [412, { detail: "It was changed meanwhile.", violations: [] }];
    }
    if (path.endsWith("/position")) this.change(body as Sine);
    return [200, this.held];
  }
}

async function load(server: Server) {
  stubBrowser();
  vi.stubGlobal("fetch", async (url: URL, { method, headers, body }: RequestInit) => {
    const match = (headers as Record<string, string>)["If-Match"] ?? null;
    const sent = body === undefined ? null : JSON.parse(String(body));
    const path = url.pathname.replace("/api/v1/", "");
    const [status, answer] = server.answer(String(method), path, match, sent);
    return new Response(JSON.stringify(answer), { status });
  });
  const { putPosition, start } = await import("../../../src/core/api/client");
  const { perform, problem } = await import("../../../src/core/state/actions");
  const { session } = await import("../../../src/core/state/session");
  const { currentValueOr: standing } = await import("../../../src/core/state/conflicts");
  const { t } = await import("../../../src/core/text/t");
  session.value = stateAt("1.0") as never;
  const set = (change: Partial<Sine>, seen?: State) => {
    const send: SessionRequest = (edit) =>
      putPosition({ ...(standing("position", SINE as never) as Sine), ...change })(edit);
    return perform("motion", send, seen as never);
  };
  return { set, start: () => perform("session", start), problem, session, t };
}

let server: Server;
beforeEach(() => {
  vi.resetModules();
  server = new Server();
});
afterEach(() => vi.unstubAllGlobals());

describe("a setting that another user changes concurrently", () => {
  it("is sent with the displayed revision, and other calls without a revision", async () => {
    const page = await load(server);
    expect(await page.set({ amplitude_rad: 0.5 })).toBe(true);
    await page.start();
    expect(server.asked).toEqual(['PUT /position "1.0"', "POST /start -"]);
  });

  it("is rejected with the current value, which the page shows", async () => {
    const page = await load(server);
    server.change({ amplitude_rad: Math.PI / 4 });
    expect(await page.set({ frequency_hz: 0.5 })).toBe(false);
    expect(page.problem.value?.message).toBe(
      "Another user changed this value; your change was not applied. Current value: Amplitude 45 deg.",
    );
    expect(page.session.value?.configuration.position).toEqual(server.held.configuration.position);
    expect(server.held.configuration.position.frequency_hz).toBe(0.2);
  });

  it("is merged with the change of the other user if the user retries", async () => {
    const page = await load(server);
    server.change({ amplitude_rad: Math.PI / 4 });
    await page.set({ frequency_hz: 0.5 });
    expect(await page.problem.value?.retry?.()).toBe(true);
    expect(page.problem.value).toBeNull();
    const both = { ...SINE, amplitude_rad: Math.PI / 4, frequency_hz: 0.5 };
    expect(server.held.configuration.position).toEqual(both);
    server.change({ amplitude_rad: 0.1 });
    expect(await page.set({ frequency_hz: 0.4 }), "asked again each time").toBe(false);
  });

  it("is sent completely if the current value has another kind", async () => {
    const page = await load(server);
    const constant = { kind: "constant", position_rad: 1 };
    server.held = { ...stateAt("1.1"), ...{ configuration: { position: constant } } } as never;
    await page.set({ frequency_hz: 0.5 });
    expect(await page.problem.value?.retry?.()).toBe(true);
    expect(server.held.configuration.position).toMatchObject({ ...SINE, frequency_hz: 0.5 });
  });

  it("is compared with the value displayed when the draft was started", async () => {
    const page = await load(server);
    const begun = stateAt("1.0");
    server.change({ amplitude_rad: Math.PI / 4 });
    page.session.value = server.held as never;
    expect(await page.set({ frequency_hz: 0.5 }, begun)).toBe(false);
    expect(await page.set({ frequency_hz: 0.5 })).toBe(true);
  });
});

describe("a setting after a change of another setting", () => {
  it("is sent again with the new revision, without a message", async () => {
    const page = await load(server);
    server.change({}, "fl");
    expect(await page.set({ amplitude_rad: 0.5 })).toBe(true);
    expect(page.problem.value).toBeNull();
    expect(server.asked).toEqual(['PUT /position "1.0"', "GET  -", 'PUT /position "1.1"']);
    expect(server.held.configuration).toMatchObject({
      law: "fl",
      position: { amplitude_rad: 0.5 },
    });
  });

  it("is not attributed to another user if this page has set it", async () => {
    const page = await load(server);
    await page.set({ amplitude_rad: 0.5 });
    expect(await page.set({ amplitude_rad: 0.6 }, stateAt("1.0"))).toBe(true);
    expect(server.held.configuration.position.amplitude_rad).toBe(0.6);
  });

  it("is reported after several retries if other users keep changing settings", async () => {
    const page = await load(server);
    const answer = server.answer.bind(server);
    server.answer = (...asked) => {
      if (asked[0] === "PUT") server.change({}, "fl");
      return answer(...asked);
    };
    expect(await page.set({ amplitude_rad: 0.5 })).toBe(false);
    expect(page.problem.value?.message).toContain(page.t("meanwhile.changed"));
    expect(server.asked.filter((one) => one.startsWith("PUT"))).toHaveLength(6);
  });
});

describe("a law that another user has set", () => {
  it("is named in the message", async () => {
    await load(server);
    const { describeChange, isSame } = await import("../../../src/core/state/conflicts");
    const before = stateAt("1.0") as never;
    const now = stateAt("1.1", SINE, "fl") as never;
    expect(describeChange("/law", before, now)).toContain("Current value: law fl.");
    expect(isSame("/law", before, now)).toBe(false);
    expect(isSame("/lanes/2", before, now)).toBe(true);
  });
});
