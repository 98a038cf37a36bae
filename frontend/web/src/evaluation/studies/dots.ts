/**
 * Draws 100,000 dots at once, pixel by pixel: a disc for success, a ring for failure, a cross for a
 * fault.
 */
import type uPlot from "uplot";

interface Dots {
  x: Float64Array;
  y: Float64Array;
  /** Index of each dot's color in `colours`. */
  lineStyles: Float64Array;
  good: Float64Array;
  ended: Uint8Array;
  marks: Uint8Array;
  /** "#rrggbb" */
  colours: readonly string[];
  faint: string;
}

type Offset = readonly [number, number];
const MANY = 20_000;
const square = (from: number, to: number, keep: (x: number, y: number) => boolean): Offset[] => {
  const offsets: Offset[] = [];
  for (let y = from; y <= to; y++)
    for (let x = from; x <= to; x++) if (keep(x, y)) offsets.push([x, y]);
  return offsets;
};
const LARGE = {
  disc: square(-2, 2, (x, y) => x * x + y * y <= 5),
  ring: square(-3, 3, (x, y) => x * x + y * y <= 10 && x * x + y * y >= 5),
  cross: square(-3, 3, (x, y) => Math.abs(x) === Math.abs(y)),
};
const SMALL = {
  disc: square(0, 1, () => true),
  ring: square(-1, 1, (x, y) => x !== 0 || y !== 0),
  cross: square(-1, 1, (x, y) => Math.abs(x) === Math.abs(y)),
};

/** "#rrggbb" as the four bytes of a pixel. */
export function packColour(colour: string, alpha: number): number {
  const value = Number.parseInt(colour.slice(1), 16);
  const [red, green, blue] = [(value >> 16) & 255, (value >> 8) & 255, value & 255];
  return ((alpha << 24) | (blue << 16) | (green << 8) | red) >>> 0;
}

export function paintDots(plot: uPlot, dots: Dots): void {
  const { left, top, width, height } = plot.bbox;
  const [columns, lines] = [Math.round(width), Math.round(height)];
  if (columns < 1 || lines < 1) return;
  const image = new ImageData(columns, lines);
  const pixels = new Uint32Array(image.data.buffer);
  const looks = dots.x.length > MANY ? SMALL : LARGE;
  const scale = plot.scales.x?.distr === 3 ? Math.log : (value: number) => value;
  const rise = plot.scales.y?.distr === 3 ? Math.log : (value: number) => value;
  const [x0, x1] = [scale(plot.scales.x?.min ?? 0), scale(plot.scales.x?.max ?? 1)];
  const [y0, y1] = [rise(plot.scales.y?.min ?? 0), rise(plot.scales.y?.max ?? 1)];
  const colours = dots.colours.map((colour) => packColour(colour, 235));
  const faint = packColour(dots.faint, 70);
  for (const round of [0, 1]) {
    for (let index = 0; index < dots.x.length; index++) {
      if (dots.marks[index] !== round) continue;
      const across = Math.round(((scale(dots.x[index] as number) - x0) / (x1 - x0)) * columns);
      const down = Math.round((1 - (rise(dots.y[index] as number) - y0) / (y1 - y0)) * lines);
      if (!(across >= 0 && across < columns && down >= 0 && down < lines)) continue;
      const look = dots.ended[index] ? looks.cross : dots.good[index] ? looks.disc : looks.ring;
      const colour = round === 0 ? faint : (colours[dots.lineStyles[index] as number] ?? faint);
      for (const [dx, dy] of look) {
        const [x, y] = [across + dx, down + dy];
        if (x >= 0 && x < columns && y >= 0 && y < lines) pixels[y * columns + x] = colour;
      }
    }
  }
  const layer = new OffscreenCanvas(columns, lines);
  layer.getContext("2d")?.putImageData(image, 0, 0);
  plot.ctx.drawImage(layer, Math.round(left), Math.round(top));
}
