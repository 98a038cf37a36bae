import { beforeEach, expect, it, vi } from "vitest";
import "../../browserless";
import type { SessionState } from "../../../src/core/api/types";

const HUNG = { id: 7, active: true, start_s: 1, load: { kind: "paper" } };
const stateOf = (tick: number, loads: object[]): SessionState =>
  ({
    ...{ run_number: 1, tick, bench: null, lanes: [], time_s: 2 },
    loads,
  }) as unknown as SessionState;

let sent: string[] = [];

beforeEach(() => {
  sent = [];
  vi.resetModules();
  vi.stubGlobal("fetch", async (address: URL | string, { method = "GET" }: RequestInit) => {
    sent.push(`${method} ${String(address).split("/sessions/")[1]}`);
    const isHung = sent.filter((call) => !call.startsWith("GET")).length === 1;
    const answer = method === "POST" ? HUNG : stateOf(2, isHung ? [HUNG] : []);
    return new Response(JSON.stringify(answer), {
      headers: { "Content-Type": "application/json" },
    });
  });
});

it("a button and its key at once hang 3 kg and take them off, and never hang them twice", async () => {
  const { session } = await import("../../../src/core/state/session");
  const { toggleWeight } = await import("../../../src/core/state/commands");
  session.value = stateOf(1, []);
  await Promise.all([toggleWeight(), toggleWeight()]);
  expect(sent.filter((call) => !call.startsWith("GET"))).toEqual([
    "POST lab/loads",
    "DELETE lab/loads/7",
  ]);
});
