import { afterEach, describe, expect, it, vi } from "vitest";
import { backoffMs, type ProbeResult, StreamConnection } from "../../../src/core/stream/connection";

describe("reconnecting", () => {
  it("waits longer each time, up to about four seconds", () => {
    const waits = [0, 1, 2, 3, 4, 9].map((attempt) => backoffMs(attempt, 0.5));
    expect(waits).toEqual([500, 1000, 2000, 4000, 4000, 4000]);
    expect(backoffMs(0, 0)).toBeLessThan(backoffMs(0, 1));
  });
});

interface Socket {
  onclose: (() => void) | null;
  onmessage: ((event: { data: string }) => void) | null;
  close: () => void;
}

/** Every socket that is opened. */
function stubSockets(): Socket[] {
  const sockets: Socket[] = [];
  vi.stubGlobal(
    "WebSocket",
    class {
      onclose: (() => void) | null = null;
      onmessage: ((event: { data: string }) => void) | null = null;
      constructor() {
        sockets.push(this);
      }
      close() {}
    },
  );
  return sockets;
}

/** An open connection with fake timers, its sockets and the phases that it reports. */
function openStream(probe: () => Promise<ProbeResult>, isBlocked = async () => false) {
  vi.useFakeTimers();
  const sockets = stubSockets();
  const phases: string[] = [];
  new StreamConnection(() => new URL("ws://lab/stream"), probe, isBlocked, {
    onPhase: (phase) => void phases.push(phase),
    onText: () => {},
    onBinary: () => {},
  }).open();
  return { sockets, phases };
}

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("a stream with a slow first connection", () => {
  it("is reported as lost only after it was connected", async () => {
    const { sockets, phases } = openStream(async () => "down");
    await vi.advanceTimersByTimeAsync(20_000);
    expect(sockets.length, "it has tried again").toBeGreaterThan(1);
    expect(phases).toEqual([]);
    sockets.at(-1)?.onmessage?.({ data: "{}" });
    sockets.at(-1)?.onclose?.();
    expect(phases).toEqual(["live", "lost"]);
    await vi.advanceTimersByTimeAsync(20_000);
    expect(new Set(phases.slice(1)), "a silent new connection is not live").toEqual(
      new Set(["lost"]),
    );
  });
});

describe("a stream that stalls", () => {
  it("is busy, then blocked if the server reports that its sessions do not respond", async () => {
    let result: ProbeResult = "blocked";
    const { sockets, phases } = openStream(
      async () => result,
      async () => true,
    );
    sockets[0]?.onmessage?.({ data: "{}" });
    await vi.advanceTimersByTimeAsync(4500);
    expect(phases).toEqual(["live", "busy"]);
    await vi.advanceTimersByTimeAsync(20_000);
    expect(new Set(phases.slice(2))).toEqual(new Set(["blocked"]));
    result = "down";
    await vi.advanceTimersByTimeAsync(20_000);
    expect(phases.at(-1), "the server has ended").toBe("lost");
    sockets.at(-1)?.onmessage?.({ data: "{}" });
    expect(phases.at(-1)).toBe("live");
  });

  it("is slow after 2 s and lost after 5 s, and goes on with the same connection", async () => {
    const { sockets, phases } = openStream(() => new Promise(() => {}));
    sockets[0]?.onmessage?.({ data: "{}" });
    await vi.advanceTimersByTimeAsync(4500);
    expect(phases).toEqual(["live", "slow"]);
    sockets[0]?.onmessage?.({ data: "{}" });
    await vi.advanceTimersByTimeAsync(5500);
    sockets[0]?.onmessage?.({ data: "{}" });
    expect(phases.slice(2)).toEqual(["live", "slow", "lost", "live"]);
    expect(sockets).toHaveLength(1);
  });
});

describe("a stream whose session has ended", () => {
  it("reports it and does not reconnect automatically, unlike a broken one", async () => {
    const results: ProbeResult[] = ["up", "ended"];
    const { sockets, phases } = openStream(async () => results.shift() ?? "down");
    sockets.at(-1)?.onclose?.();
    await vi.advanceTimersByTimeAsync(10_000);
    expect(sockets.length, "it was there: opened again").toBeGreaterThan(1);
    const opened = sockets.length;
    sockets.at(-1)?.onclose?.();
    await vi.advanceTimersByTimeAsync(60_000);
    expect(phases.at(-1)).toBe("ended");
    expect(sockets).toHaveLength(opened);
  });
});
