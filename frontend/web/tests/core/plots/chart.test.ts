import "../../browserless";
import { expect, it, vi } from "vitest";
import type { Trace } from "../../../src/core/plots/definitions";
import type { Frame } from "../../../src/core/plots/layer";
import { SampleRing } from "../../../src/core/stream/ring";

const { drawn, redraw } = vi.hoisted(() => ({
  drawn: [] as Frame[],
  redraw: [] as (() => void)[],
}));

vi.mock("uplot", () => ({
  default: class {
    static pxRatio = 1;
    bbox = { left: 0, top: 0, width: 100, height: 50 };
    scales = { x: { min: 0, max: 1 }, y: { min: 0, max: 1 } };
    constructor({ hooks }: { hooks: { draw: (() => void)[] } }) {
      redraw.splice(0, redraw.length, ...hooks.draw);
    }
    batch(change: () => void) {
      change();
      for (const hook of redraw) hook();
    }
    setData() {}
    setScale() {}
    setSize() {
      for (const hook of redraw) hook();
    }
  },
}));
vi.mock("../../../src/core/plots/layer", () => ({
  StrokeLayer: class {
    draw(frame: Frame) {
      drawn.push(frame);
    }
    paint() {}
  },
}));
vi.mock("../../../src/core/plots/marks", () => ({
  drawBeginning() {},
  drawBounds() {},
  drawCursorSamples() {},
}));

const TRACE: Trace = {
  ...{ key: "error", channel: "position_error_rad", lane: 1, label: "", factor: 1, sign: "none" },
  ...{ from: 0, to: Number.POSITIVE_INFINITY, colour: "blue", dash: [], width: 2 },
};
const append = (ring: SampleRing, firstTick: number, count: number) =>
  ring.append(
    {
      run: 1,
      firstTick,
      stride: 10,
      missed: 0,
      lanes: [1],
      count,
      values: new Float32Array(count),
    },
    0.001,
  );

it("a plot that redraws itself does not mark samples as drawn that its curves lack", async () => {
  const { Chart } = await import("../../../src/core/plots/chart");
  const ring = new SampleRing(1000, ["position_error_rad"], [1]);
  let span = { from: 0, to: 1 };
  const host = { clientWidth: 100, clientHeight: 50 } as HTMLElement;
  const view = { ring: () => ring, span: () => span, hasCursors: false };
  const chart = new Chart(
    host,
    [TRACE],
    1,
    view as unknown as ConstructorParameters<typeof Chart>[3],
  );
  append(ring, 0, 100);
  chart.draw();
  append(ring, 1000, 180);
  span = { from: 1.8, to: 2.8 };
  for (const hook of redraw) hook();
  chart.draw();
  expect(drawn.map(({ newest, span: { to } }) => [newest, to])).toEqual([
    [0.99, 1],
    [0.99, 1],
    [2.79, 2.8],
  ]);
});
