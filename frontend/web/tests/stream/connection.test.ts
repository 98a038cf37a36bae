import { describe, expect, it, vi } from "vitest";
import { backoffMs, type Finding, StreamConnection } from "../../src/stream/connection";

describe("reconnecting", () => {
  it("waits longer each time, up to about four seconds", () => {
    const waits = [0, 1, 2, 3, 4, 9].map((attempt) => backoffMs(attempt, 0.5));
    expect(waits).toEqual([500, 1000, 2000, 4000, 4000, 4000]);
    expect(backoffMs(0, 0)).toBeLessThan(backoffMs(0, 1));
  });
});

describe("a stream whose session has ended", () => {
  it("says so and does not come back by itself, while one that only broke does", async () => {
    vi.useFakeTimers();
    const sockets: { onclose: (() => void) | null; close: () => void }[] = [];
    vi.stubGlobal(
      "WebSocket",
      class {
        onclose: (() => void) | null = null;
        constructor() {
          sockets.push(this);
        }
        close() {}
      },
    );
    const findings: Finding[] = ["up", "ended"];
    const phases: string[] = [];
    const connection = new StreamConnection(
      () => new URL("ws://lab/stream"),
      async () => findings.shift() ?? "down",
      { onPhase: (phase) => void phases.push(phase), onText: () => {}, onBinary: () => {} },
    );
    connection.open();
    sockets.at(-1)?.onclose?.();
    await vi.advanceTimersByTimeAsync(10_000);
    expect(sockets.length, "it was there: opened again").toBeGreaterThan(1);
    const opened = sockets.length;
    sockets.at(-1)?.onclose?.();
    await vi.advanceTimersByTimeAsync(60_000);
    expect(phases.at(-1)).toBe("ended");
    expect(sockets).toHaveLength(opened);
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });
});
