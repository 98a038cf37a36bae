/** Dots of a study: scales, brush, nearest dot, success rate over a plane, distributions. */

export type Span = readonly [number, number];

export interface Brush {
  x: Span;
  y: Span;
}

/** Smallest and greatest number, and the smallest above zero; null without any. */
export function extentOf(
  values: Float64Array,
): { low: number; high: number; positive: number } | null {
  let [low, high, positive] = [Infinity, -Infinity, Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high && value < Infinity) high = value;
    if (value > 0 && value < positive) positive = value;
  }
  return low <= high ? { low, high, positive } : null;
}

/** A scale with a margin around all values, logarithmic if requested and possible. */
export function scaleOf(values: Float64Array, isLog: boolean): { span: Span; isLog: boolean } {
  const extent = extentOf(values);
  if (extent === null) return { span: [0, 1], isLog: false };
  const { low, high } = extent;
  if (isLog && low > 0 && high > low) {
    const air = (high / low) ** 0.03;
    return { span: [low / air, high * air], isLog: true };
  }
  const air = high > low ? 0.03 * (high - low) : Math.max(0.5, Math.abs(low) * 0.05);
  return { span: [low - air, high + air], isLog: false };
}

/** Whether the range of values suits a logarithmic scale. */
export function spreadsByRatios(values: Float64Array): boolean {
  const extent = extentOf(values);
  return extent !== null && extent.low > 0 && extent.high > 30 * extent.low;
}

const LOT = 0.618033988749895;

/** Categories are equally spaced; dots of a category are jittered, always in the same way. */
export function spreadNames(codes: Float64Array): Float64Array {
  return codes.map((code, index) => code + 0.6 * (((index * LOT) % 1) - 0.5));
}

/** 1 for each dot in the brush; all of them without a brush. */
export function markBrushed(x: Float64Array, y: Float64Array, brush: Brush | null): Uint8Array {
  const marks = new Uint8Array(x.length);
  if (brush === null) return marks.fill(1);
  const [left, right] = brush.x;
  const [bottom, top] = brush.y;
  for (let index = 0; index < marks.length; index++) {
    const [at, height] = [x[index] as number, y[index] as number];
    if (at >= left && at <= right && height >= bottom && height <= top) marks[index] = 1;
  }
  return marks;
}

/** The nearest marked dot; null if none is within `reach`. */
export function findNearest(
  x: Float64Array,
  y: Float64Array,
  marks: Uint8Array,
  place: (x: number, y: number) => readonly [number, number],
  at: readonly [number, number],
  reach: number,
): number | null {
  let [best, nearest] = [reach * reach, -1];
  for (let index = 0; index < marks.length; index++) {
    if (marks[index] === 0) continue;
    const [left, top] = place(x[index] as number, y[index] as number);
    const distance = (left - at[0]) ** 2 + (top - at[1]) ** 2;
    if (distance <= best) [best, nearest] = [distance, index];
  }
  return nearest < 0 ? null : nearest;
}

interface Cell {
  column: number;
  line: number;
  runs: number;
  good: number;
}

/**
 * Edges of bins: between the values if there are few distinct ones, as on a grid; otherwise equally
 * spaced.
 */
export function cutBins(values: Float64Array, isLog: boolean, most = 16): number[] {
  const distinct = new Set<number>();
  for (const value of values) {
    if (Number.isFinite(value)) distinct.add(value);
    if (distinct.size > 3 * most) break;
  }
  const levels = [...distinct].sort((a, b) => a - b);
  const by = isLog && (levels[0] ?? 0) > 0 ? Math.log : (value: number) => value;
  const back = by === Math.log ? Math.exp : (value: number) => value;
  if (levels.length === 0) return [];
  const isGrid = levels.length <= 3 * most && levels.length ** 2 <= values.length;
  if (isGrid && levels.length > 1) {
    const at = levels.map(by);
    const middles = at.slice(1).map((value, index) => (value + (at[index] as number)) / 2);
    const first = 2 * (at[0] as number) - (middles[0] as number);
    const last = 2 * (at.at(-1) as number) - (middles.at(-1) as number);
    return [first, ...middles, last].map(back);
  }
  const extent = extentOf(values) as { low: number; high: number };
  const [low, high] = [by(extent.low), by(extent.high)];
  const width = (high - low || 1) / most;
  return Array.from({ length: most + 1 }, (_, index) => back(low + index * width));
}

/** Index of a value's bin; -1 for none. */
export function findBin(edges: readonly number[], value: number): number {
  const last = edges.length - 2;
  if (!(value >= (edges[0] as number)) || value > (edges[last + 1] as number) * (1 + 1e-12))
    return -1;
  let [low, high] = [0, last];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (value >= (edges[middle] as number)) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Number of runs and of successful runs in each non-empty cell of a plane. */
export function countCells(
  x: Float64Array,
  y: Float64Array,
  good: Float64Array,
  marks: Uint8Array,
  edges: readonly [readonly number[], readonly number[]],
): Cell[] {
  const [columns, lines] = [edges[0].length - 1, edges[1].length - 1];
  if (columns < 1 || lines < 1) return [];
  const runs = new Uint32Array(columns * lines);
  const goods = new Uint32Array(columns * lines);
  for (let index = 0; index < marks.length; index++) {
    if (marks[index] === 0) continue;
    const column = findBin(edges[0], x[index] as number);
    const line = findBin(edges[1], y[index] as number);
    if (column < 0 || line < 0) continue;
    const at = line * columns + column;
    runs[at] = (runs[at] as number) + 1;
    if (good[index] === 1) goods[at] = (goods[at] as number) + 1;
  }
  const cells: Cell[] = [];
  runs.forEach((count, at) => {
    if (count > 0) {
      const good = goods[at] as number;
      cells.push({ column: at % columns, line: Math.floor(at / columns), runs: count, good });
    }
  });
  return cells;
}

/**
 * Cumulative distribution of the marked runs, in percent; a run without a value, which ended in a
 * fault, counts in the total only.
 */
export function distribute(
  values: Float64Array,
  ended: Uint8Array,
  marks: Uint8Array,
  at: readonly number[],
): number[] {
  const finiteValues: number[] = [];
  let count = 0;
  for (let index = 0; index < marks.length; index++) {
    if (marks[index] === 0) continue;
    count++;
    const value = values[index] as number;
    if (ended[index] === 0 && !Number.isNaN(value)) finiteValues.push(value);
  }
  const sorted = Float64Array.from(finiteValues).sort();
  let reached = 0;
  return at.map((limit) => {
    while (reached < sorted.length && (sorted[reached] as number) <= limit) reached++;
    return (100 * reached) / Math.max(1, count);
  });
}
