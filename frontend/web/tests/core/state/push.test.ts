import { beforeEach, describe, expect, it, vi } from "vitest";
import type { SessionState } from "../../../src/core/api/types";

const asked: string[] = [];
let isPushOn = false;
let kind = "";

interface PushLoad {
  kind: string;
  torque_nm?: number[];
  force_n?: number[];
}

vi.mock("../../../src/core/api/client", () => {
  const state = () => ({ loads: isPushOn ? [{ id: 7, load: { kind } }] : [] });
  return {
    addLoad: (load: PushLoad) => async () => {
      isPushOn = true;
      kind = load.kind;
      asked.push(`${kind} ${(load.force_n ?? load.torque_nm?.slice(0, 1))?.join(" ")}`);
      return state();
    },
    removeLoad: (id: number) => async () => {
      isPushOn = false;
      asked.push(`remove ${id}`);
      return state();
    },
  };
});
vi.mock("../../../src/core/state/actions", () => ({
  perform: (_: string, request: () => Promise<unknown>) => request().then(() => true),
}));
vi.mock("../../../src/core/state/session", async () => {
  const { signal } = await import("@preact/signals");
  return {
    acceptState: () => undefined,
    session: signal({ speed: 1, real_time_factor: 1 } as SessionState),
  };
});

const { holdDuration, linkPush, tipPush } = await import("../../../src/core/state/push");

describe("a push", () => {
  beforeEach(() => {
    asked.length = 0;
    vi.useFakeTimers();
  });

  it("is started, changed and ended as one load", async () => {
    linkPush.hold([1]);
    await vi.advanceTimersByTimeAsync(30);
    linkPush.hold([1.5]);
    await vi.advanceTimersByTimeAsync(70);
    linkPush.release();
    await vi.advanceTimersByTimeAsync(100);
    expect(asked).toEqual(["push 1", "push 1.5", "remove 7"]);
  });

  it("at the tip of an arm has two components", async () => {
    tipPush.hold([3, -4]);
    await vi.advanceTimersByTimeAsync(30);
    tipPush.release();
    await vi.advanceTimersByTimeAsync(100);
    expect(asked).toEqual(["tip_push 3 -4", "remove 7"]);
  });

  it("is repeated without a change before the server ends it", async () => {
    linkPush.hold([1]);
    await vi.advanceTimersByTimeAsync(1000);
    linkPush.release();
    await vi.advanceTimersByTimeAsync(100);
    expect(asked.filter((one) => one === "push 1").length).toBeGreaterThanOrEqual(4);
    expect(asked.at(-1)).toBe("remove 7");
  });

  it("sends nothing if it never pulled", async () => {
    linkPush.hold([0.01]);
    await vi.advanceTimersByTimeAsync(300);
    linkPush.release();
    await vi.advanceTimersByTimeAsync(100);
    expect(asked).toEqual([]);
  });

  it("lasts equally long in wall time at any speed of the session", () => {
    expect(holdDuration({ speed: 0.5, real_time_factor: 0.5 })).toBeCloseTo(0.4, 9);
    expect(holdDuration({ speed: "max", real_time_factor: 20 })).toBeCloseTo(16, 9);
    expect(holdDuration({ speed: "max", real_time_factor: 1e4 })).toBe(60);
  });

  it("is sent when it starts, changes, or has not been sent for a while", () => {
    expect(linkPush.isUpdateDue([0.04], null, 0)).toBe(false);
    expect(linkPush.isUpdateDue([0.06], null, 0)).toBe(true);
    expect(linkPush.isUpdateDue([1], [1.01], 100)).toBe(false);
    expect(linkPush.isUpdateDue([1], [1.1], 0)).toBe(true);
    expect(linkPush.isUpdateDue([1], [1], 200)).toBe(true);
  });
});
