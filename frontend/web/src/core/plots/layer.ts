/**
 * The curves of a plot on a separate canvas. While time advances, only new samples are drawn, over
 * columns that have left the plot: the canvas is a ring buffer of columns with a moving left edge.
 * Drawn pixels stay in place, because repeated moves would blur them. Any other change redraws
 * everything.
 */
import uPlot from "uplot";
import type { SampleRing } from "../stream/ring";
import { type Curve, drawSigns, fillBands, type Place } from "./curves";
import { palette } from "./linestyles";
import type { Span } from "./spans";

/**
 * Columns of the canvas from one up to before another; `shift` maps columns of the plot to them.
 */
interface Piece {
  from: number;
  to: number;
  shift: number;
}

/**
 * Columns of the canvas that show the columns of a plot from `first` on; `start` is the canvas
 * column of the plot's column 0: up to the end of the canvas, then from its beginning.
 */
export function piecesOf(start: number, first: number, width: number): Piece[] {
  const pieces = [
    { from: start + first, to: width, shift: start },
    { from: Math.max(0, start + first - width), to: start, shift: start - width },
  ];
  return pieces.filter((piece) => piece.from < piece.to);
}

/** Everything except for time that the drawing depends on. */
export interface Frame {
  ring: SampleRing;
  span: Span;
  /** Time of the newest sample of the curves. */
  newest: number;
  min: number;
  max: number;
  /** Device pixels. */
  width: number;
  height: number;
  shown: readonly Curve[];
}

interface Drawn extends Frame {
  look: object;
  changesOfPast: number;
  /** Left edge, in pixels since time 0. */
  left: number;
}

/** Width that may still change left of the newest sample: the last buckets, and the line width. */
const UNSETTLED_BUCKETS = 3;
const STROKE_PX = 6;

function isContinued(drawn: Drawn, next: Frame): boolean {
  const length = ({ span }: Frame) => span.to - span.from;
  return (
    drawn.look === palette.peek() &&
    drawn.ring === next.ring &&
    drawn.changesOfPast === next.ring.changesOfPast &&
    Math.abs(length(drawn) - length(next)) < 1e-9 &&
    drawn.min === next.min &&
    drawn.max === next.max &&
    drawn.width === next.width &&
    drawn.height === next.height &&
    drawn.newest <= next.newest &&
    drawn.shown.length === next.shown.length &&
    drawn.shown.every((curve, index) => curve === next.shown[index])
  );
}

export class StrokeLayer {
  readonly #canvas = document.createElement("canvas");
  readonly #context = this.#canvas.getContext("2d") as CanvasRenderingContext2D;
  #drawn: Drawn | null = null;
  /** Pixel since time 0 in the first column of the canvas, and at each multiple of its width. */
  #origin = 0;

  /**
   * @param perBucketS time between two points of a curve
   */
  draw(frame: Frame, perBucketS: number): void {
    const { span, min, max, width, height, shown } = frame;
    const perSecond = width / (span.to - span.from);
    const left = Math.round(span.from * perSecond);
    const place: Place = {
      x: (time) => time * perSecond - left,
      y: (value) => ((max - value) / (max - min)) * height,
    };
    const from = this.#makeRoom(frame, left, place, perBucketS);
    const context = this.#context;
    for (const piece of this.#piecesFrom(from, left)) {
      context.save();
      context.clearRect(piece.from, 0, piece.to - piece.from, this.#canvas.height);
      context.beginPath();
      context.rect(piece.from, 0, piece.to - piece.from, this.#canvas.height);
      context.clip();
      context.translate(piece.shift, 0);
      fillBands(context, shown, place);
      // The first controller, which is selected, is on top, and the references are below all.
      for (const curve of [...shown].reverse()) {
        curve.stroke(context, place, from - STROKE_PX * uPlot.pxRatio);
        drawSigns(context, curve, place, from);
      }
      context.restore();
    }
    const { changesOfPast } = frame.ring;
    this.#drawn = { ...frame, look: palette.peek(), changesOfPast, left };
  }

  /** Copy the drawn pixels onto a plot. */
  paint(context: CanvasRenderingContext2D, x: number, y: number): void {
    if (this.#drawn === null) return;
    const { width, height } = this.#canvas;
    if (width === 0 || height === 0) return;
    context.save();
    context.imageSmoothingEnabled = false;
    for (const { from, to, shift } of this.#piecesFrom(0, this.#drawn.left)) {
      const [across, left] = [to - from, Math.round(x) + from - shift];
      context.drawImage(this.#canvas, from, 0, across, height, left, Math.round(y), across, height);
    }
    context.restore();
  }

  #piecesFrom(first: number, left: number): Piece[] {
    const { width } = this.#canvas;
    return piecesOf((left - this.#origin) % width, first, width);
  }

  /** Keep the valid part; returns the pixel of the plot at which the rest begins. */
  #makeRoom(frame: Frame, left: number, place: Place, perBucketS: number): number {
    const [width, height] = [Math.round(frame.width), Math.round(frame.height)];
    const drawn = this.#drawn;
    const shift = drawn === null ? -1 : left - drawn.left;
    if (drawn === null || !isContinued(drawn, frame) || shift < 0 || shift >= width) {
      if (this.#canvas.width !== width) this.#canvas.width = width;
      if (this.#canvas.height !== height) this.#canvas.height = height;
      this.#origin = left;
      for (const curve of frame.shown) curve.forget();
      return 0;
    }
    const settled = place.x(drawn.newest - UNSETTLED_BUCKETS * perBucketS);
    const entered = width - shift;
    const from = Math.max(0, Math.floor(Math.min(settled, entered) - STROKE_PX * uPlot.pxRatio));
    return Math.min(from, width);
  }
}
