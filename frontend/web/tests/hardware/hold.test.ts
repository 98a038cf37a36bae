import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { stubBrowser } from "../browser";

const said: string[] = [];

beforeEach(() => {
  vi.resetModules();
  vi.useFakeTimers();
  said.length = 0;
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
  vi.doUnmock("../../src/core/state/session");
  vi.doUnmock("../../src/core/state/control");
});

describe("the dead-man's switch", () => {
  async function load() {
    stubBrowser();
    vi.stubGlobal("document", new EventTarget());
    const { signal } = await import("@preact/signals");
    const mayCommand = signal(true);
    const session = signal<object | null>({ bench: { dead_man: true, status: "ready" } });
    const sendSwitchHeld = () => void said.push("held");
    vi.doMock("../../src/core/state/session", () => ({ session, sendSwitchHeld }));
    vi.doMock("../../src/core/state/control", () => ({ mayCommand }));
    return { ...(await import("../../src/hardware/hold")), mayCommand, session };
  }

  it("sends at once and every 40 ms until the last grip is released", async () => {
    const { pressInput: hold, releaseInput: letGo, isSwitchHeld: isHeld } = await load();
    hold("key");
    hold("pointer");
    expect(said).toHaveLength(1);
    vi.advanceTimersByTime(400);
    expect(said).toHaveLength(11);
    letGo("key");
    expect(isHeld.value).toBe(true);
    letGo("pointer");
    vi.advanceTimersByTime(400);
    expect([said.length, isHeld.value]).toEqual([11, false]);
  });

  it("is released when the window loses the focus, another user takes control, or the bench is lost", async () => {
    const { pressInput: hold, watchHold, isSwitchHeld: isHeld, mayCommand, session } = await load();
    watchHold();
    const losses = [
      () => window.dispatchEvent(new Event("blur")),
      () => window.dispatchEvent(new Event("pagehide")),
      () => {
        mayCommand.value = false;
      },
      () => {
        session.value = { bench: null };
      },
    ];
    for (const lose of losses) {
      mayCommand.value = true;
      hold("pointer");
      expect(isHeld.value).toBe(true);
      lose();
      expect(isHeld.value).toBe(false);
    }
    hold("pointer");
    expect(isHeld.value, "there is nothing to hold").toBe(false);
  });

  it("remembers the reason for the end of a run until it is held or runs again", async () => {
    const {
      pressInput: hold,
      releaseInput: letGo,
      holdEnd: ended,
      watchHold,
      session,
    } = await load();
    watchHold();
    hold("key");
    letGo("key");
    expect(ended.value).toBeNull();
    hold("key");
    session.value = { bench: { dead_man: true, status: "run" } };
    letGo("key");
    expect(ended.value).toBe("letGo");
    hold("key");
    expect(ended.value).toBeNull();
    vi.advanceTimersByTime(400);
    expect(ended.value).toBeNull();
    const now = vi.spyOn(performance, "now").mockReturnValue(performance.now() + 500);
    vi.advanceTimersByTime(40);
    expect(ended.value).toBeNull();
    session.value = { bench: { dead_man: true, status: "ramp" } };
    expect(ended.value).toBe("late");
    now.mockRestore();
    session.value = { bench: { dead_man: true, status: "run" } };
    expect(ended.value).toBeNull();
  });

  it("is described by the state of the bench", async () => {
    const { holdMessage: wordsFor } = await load();
    expect(wordsFor("off", false, null)).toBe("idle");
    expect(wordsFor("ready", false, null)).toBe("ready");
    expect(wordsFor("ready", true, null)).toBe("armed");
    expect(wordsFor("run", true, null)).toBe("running");
    expect(wordsFor("run", false, "letGo")).toBe("dropped");
    expect(wordsFor("ramp", true, "late")).toBe("dropped");
    expect(wordsFor("ready", false, "letGo")).toBe("letGo");
    expect(wordsFor("ready", true, "late")).toBe("late");
  });
});
