/** Marks behind and above the curves: bounds, and the samples under the cursors. */

import type uPlot from "uplot";
import type { SampleRing } from "../stream/ring";
import { t } from "../text/t";
import { formatFixed } from "../units";
import { cursorSamples } from "./cursors";
import { addSign, type Curve, placeOn } from "./curves";
import { type Bound, readPiece } from "./definitions";
import { palette } from "./linestyles";
import { shownRing } from "./span";

const LABEL_PX = 11;
const SAMPLE_PX = 4;

function strokeLine(
  context: CanvasRenderingContext2D,
  from: [number, number],
  to: [number, number],
): void {
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
}

/**
 * Faint lines at ±value of each bound that is on the axis. A label is beyond its line, where the
 * limited curve does not go.
 */
export function drawBounds(plot: uPlot, bounds: readonly Bound[]): void {
  const { min, max } = plot.scales.y as uPlot.Scale;
  if (min === undefined || max === undefined) return;
  const { ctx: context, bbox } = plot;
  context.save();
  context.setLineDash([]);
  context.lineWidth = devicePixelRatio;
  context.font = `${LABEL_PX * devicePixelRatio}px system-ui, sans-serif`;
  context.textAlign = "right";
  context.fillStyle = palette.peek().axis;
  const [right, gap] = [bbox.left + bbox.width, 3 * devicePixelRatio];
  for (const bound of bounds) {
    context.strokeStyle = palette.peek()[bound.colour];
    for (const value of [-bound.value, bound.value]) {
      if (value < min || value > max) continue;
      const y = Math.round(plot.valToPos(value, "y", true));
      context.globalAlpha = 0.6;
      strokeLine(context, [bbox.left, y], [right, y]);
      context.globalAlpha = 1;
      // Outside the limits, where no curve is, unless the plot is too low for it.
      const room = value > 0 ? y - bbox.top : bbox.top + bbox.height - y;
      const side = Math.sign(value) * (room > LABEL_PX * devicePixelRatio + gap ? 1 : -1);
      context.textBaseline = side > 0 ? "bottom" : "top";
      context.fillText(bound.label, right - gap, y - side * gap);
    }
  }
  context.restore();
}

/** The sample of each curve under cursor A as a disk, under B as a square. */
export function drawCursorSamples(plot: uPlot, curves: readonly Curve[]): void {
  const indices = cursorSamples.peek();
  if (indices === null) return;
  const { ctx: context } = plot;
  const ring = shownRing();
  const to = placeOn(plot);
  context.save();
  context.setLineDash([]);
  context.lineWidth = devicePixelRatio;
  context.strokeStyle = palette.peek().surface;
  for (const { trace } of curves) {
    context.fillStyle = palette.peek()[trace.colour];
    indices.forEach((index, which) => {
      const value = readPiece(ring, trace, index);
      const x = to.x(ring.timeAt(index));
      const isOutside = x < plot.bbox.left || x > plot.bbox.left + plot.bbox.width;
      if (Number.isNaN(value) || isOutside) return;
      const path = new Path2D();
      const sign = which === 0 ? "circle" : "square";
      addSign(path, sign, x, to.y(value), SAMPLE_PX * devicePixelRatio);
      context.fill(path);
      context.stroke(path);
    });
  }
  context.restore();
}

/** If no curve has samples as old as the ring: the time of its first sample. */
export function drawBeginning(plot: uPlot, curves: readonly Curve[], ring: SampleRing): void {
  const times = curves.map(({ trace }) => ring.firstTimeOf(trace.channel, trace.lane));
  const begin = Math.min(...times.filter((time) => !Number.isNaN(time)));
  if (!(begin > ring.oldestTime) || begin === Number.POSITIVE_INFINITY) return;
  const { ctx: context, bbox } = plot;
  const x = Math.min(placeOn(plot).x(begin), bbox.left + bbox.width);
  if (x <= bbox.left) return;
  const words = t("plots.beginning", { seconds: formatFixed(begin, 2) });
  const gap = 5 * devicePixelRatio;
  context.save();
  context.font = `${LABEL_PX * devicePixelRatio}px system-ui, sans-serif`;
  context.textBaseline = "middle";
  context.fillStyle = palette.peek().axis;
  const isRoomLeft = x - bbox.left > context.measureText(words).width + 2 * gap;
  context.textAlign = isRoomLeft ? "right" : "left";
  context.fillText(words, isRoomLeft ? x - gap : x + gap, bbox.top + bbox.height / 2);
  context.restore();
}
