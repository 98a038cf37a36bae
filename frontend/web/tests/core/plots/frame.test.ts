import "../../browserless";
import { beforeAll, beforeEach, expect, it, vi } from "vitest";

type Modules = typeof import("../../../src/core/plots/frame") &
  typeof import("../../../src/core/plots/span") &
  typeof import("../../../src/core/plots/cursors") &
  typeof import("../../../src/core/state/preferences") &
  typeof import("../../../src/core/state/session");

const asked: FrameRequestCallback[] = [];
const FRAME_MS = 50;
let now = 0;
let page: Modules;

/** Runs the requested animation frame; returns the number of requests. */
function passFrame(lapseMs = FRAME_MS): number {
  const callbacks = asked.splice(0);
  now += lapseMs;
  for (const callback of callbacks) callback(now);
  return callbacks.length;
}

/** Runs frames while they are requested; returns their number. */
function passFrames(): number {
  let count = 0;
  while (passFrame() > 0) count++;
  return count;
}

beforeAll(async () => {
  vi.stubGlobal("requestAnimationFrame", (callback: FrameRequestCallback) => asked.push(callback));
  vi.stubGlobal("getComputedStyle", () => ({ getPropertyValue: () => "" }));
  page = {
    ...(await import("../../../src/core/plots/frame")),
    ...(await import("../../../src/core/plots/span")),
    ...(await import("../../../src/core/plots/cursors")),
    ...(await import("../../../src/core/state/preferences")),
    ...(await import("../../../src/core/state/session")),
  };
  page.startFrames();
});

beforeEach(() => {
  page.goLive();
  passFrames();
});

it("requests no frame without a plot", () => {
  page.incrementReceived();
  expect(asked.length).toBe(0);
});

it("draws a new plot in one frame and then requests none", () => {
  const draw = vi.fn();
  const drawing = page.addDrawing(draw);
  expect(passFrames()).toBe(1);
  expect(draw).toHaveBeenCalledOnce();
  expect(asked.length).toBe(0);
  drawing.remove();
});

it("requests one frame for all samples that arrive before it", () => {
  const draw = vi.fn();
  const follow = vi.fn();
  const drawing = page.addDrawing(draw);
  const stop = page.onFrame(follow);
  passFrames();
  const [drawn, followed] = [draw.mock.calls.length, follow.mock.calls.length];
  page.incrementReceived();
  page.incrementReceived();
  expect(asked.length).toBe(1);
  expect(passFrames()).toBe(1);
  expect(draw).toHaveBeenCalledTimes(drawn + 1);
  expect(follow).toHaveBeenCalledTimes(followed + 1);
  drawing.remove();
  stop();
});

it("also draws the last samples if they arrive faster than it draws", () => {
  let shown = -1;
  const stop = page.onFrame(() => {
    shown = page.receivedCount.peek();
  });
  passFrames();
  page.incrementReceived();
  passFrame();
  page.incrementReceived();
  passFrame(1);
  expect(shown).toBe(page.receivedCount.peek() - 1);
  passFrames();
  expect(shown).toBe(page.receivedCount.peek());
  stop();
});

it.each([
  ["the length of the span", () => page.setWindow(page.windowS.peek() === 5 ? 10 : 5)],
  ["the theme", () => page.toggleTheme()],
  ["what is held", () => page.freeze()],
  ["the cursors", () => page.toggleCursors()],
])("draws again after a change of %s", (_, change) => {
  page.samples.ring.append(
    {
      ...{ run: 1, firstTick: 0, stride: 1, missed: 0, lanes: [1], count: 2 },
      values: new Float32Array(0),
    },
    0.001,
  );
  const draw = vi.fn();
  const drawing = page.addDrawing(draw);
  passFrames();
  draw.mockClear();
  change();
  expect(passFrames()).toBeGreaterThan(0);
  expect(draw).toHaveBeenCalled();
  drawing.remove();
});

it("draws no samples while frozen, and draws those received when it goes live", () => {
  const draw = vi.fn();
  const drawing = page.addDrawing(draw);
  page.freeze();
  passFrames();
  draw.mockClear();
  page.incrementReceived();
  expect(asked.length).toBe(0);
  page.goLive();
  expect(passFrames()).toBe(1);
  expect(draw).toHaveBeenCalledOnce();
  drawing.remove();
});

it("does not draw a plot outside the viewport, and draws it when it is visible again", () => {
  const draw = vi.fn();
  const drawing = page.addDrawing(draw);
  drawing.setVisible(false);
  passFrames();
  draw.mockClear();
  page.incrementReceived();
  passFrames();
  expect(draw).not.toHaveBeenCalled();
  drawing.setVisible(true);
  expect(passFrames()).toBe(1);
  expect(draw).toHaveBeenCalledOnce();
  drawing.remove();
});

it("draws only the resized plot again", () => {
  const [draw, other] = [vi.fn(), vi.fn()];
  const drawings = [page.addDrawing(draw), page.addDrawing(other)];
  passFrames();
  const before = other.mock.calls.length;
  drawings[0]?.redraw();
  expect(passFrames()).toBe(1);
  expect(draw).toHaveBeenCalledTimes(before + 1);
  expect(other).toHaveBeenCalledTimes(before);
  for (const drawing of drawings) drawing.remove();
});
