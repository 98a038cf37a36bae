import { beforeEach, describe, expect, it, vi } from "vitest";
import type { SessionState } from "../../../src/core/api/types";

const asked: string[] = [];
let isPushOn = false;

vi.mock("../../../src/core/api/client", () => {
  const state = () => ({ loads: isPushOn ? [{ id: 7, load: { kind: "push" } }] : [] });
  return {
    addLoad: async ({ torque_nm: [link] }: { torque_nm: number[] }) => {
      isPushOn = true;
      asked.push(`push ${link}`);
      return state();
    },
    removeLoad: async (id: number) => {
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

const { heldTorque, holdOf, isUpdateDue, keepPush } = await import("../../../src/lab/scene/hold");

describe("a push", () => {
  beforeEach(() => {
    asked.length = 0;
    vi.useFakeTimers();
  });

  it("is begun, changed and ended as one load", async () => {
    heldTorque.value = 1;
    const kept = keepPush();
    await vi.advanceTimersByTimeAsync(30);
    heldTorque.value = 1.5;
    void keepPush();
    await vi.advanceTimersByTimeAsync(70);
    heldTorque.value = null;
    await vi.advanceTimersByTimeAsync(100);
    await kept;
    expect(asked).toEqual(["push 1", "push 1.5", "remove 7"]);
  });

  it("that does not change is sent again before the server ends it", async () => {
    heldTorque.value = 1;
    const kept = keepPush();
    await vi.advanceTimersByTimeAsync(1000);
    heldTorque.value = null;
    await vi.advanceTimersByTimeAsync(100);
    await kept;
    expect(asked.filter((one) => one === "push 1").length).toBeGreaterThanOrEqual(4);
    expect(asked.at(-1)).toBe("remove 7");
  });

  it("that never pulled asks nothing", async () => {
    heldTorque.value = 0.01;
    const kept = keepPush();
    await vi.advanceTimersByTimeAsync(300);
    heldTorque.value = null;
    await vi.advanceTimersByTimeAsync(100);
    await kept;
    expect(asked).toEqual([]);
  });

  it("lasts as long on the wall however fast the session goes", () => {
    expect(holdOf({ speed: 0.5, real_time_factor: 0.5 })).toBeCloseTo(0.4, 9);
    expect(holdOf({ speed: "max", real_time_factor: 20 })).toBeCloseTo(16, 9);
    expect(holdOf({ speed: "max", real_time_factor: 1e4 })).toBe(60);
  });

  it("is sent when it begins, differs, or has been silent", () => {
    expect(isUpdateDue(0.04, null, 0)).toBe(false);
    expect(isUpdateDue(0.06, null, 0)).toBe(true);
    expect(isUpdateDue(1, 1.01, 100)).toBe(false);
    expect(isUpdateDue(1, 1.1, 0)).toBe(true);
    expect(isUpdateDue(1, 1, 200)).toBe(true);
  });
});
