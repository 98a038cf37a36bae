/**
 * The newest samples of a session, one column a channel and lane, in arrays that are never
 * reallocated. A lane is there from the first batch that has it, with no number before, and goes
 * with its past with the first batch that has it no more.
 */
import type { Batch } from "./decoder";

export class SampleRing {
  readonly capacity: number;
  readonly channels: readonly string[];
  readonly #time: Float64Array;
  readonly #lanes: Map<string, Float32Array>[] = [];
  #next = 0;
  #length = 0;

  constructor(capacity: number, channels: readonly string[]) {
    this.capacity = capacity;
    this.channels = channels;
    this.#time = new Float64Array(capacity);
  }

  get length(): number {
    return this.#length;
  }

  /** Time of the newest sample, s; NaN when there is none. */
  get newestTime(): number {
    return this.#length === 0 ? Number.NaN : (this.#time[this.#slot(this.#length - 1)] as number);
  }

  /** How many lanes there are. */
  get lanes(): number {
    return this.#lanes.length;
  }

  clear(): void {
    this.#next = 0;
    this.#length = 0;
  }

  append(batch: Batch, periodS: number): void {
    this.#setLanes(batch.lanes);
    const width = batch.lanes * this.channels.length;
    const skipped = Math.max(0, batch.count - this.capacity);
    for (let row = skipped; row < batch.count; row++) {
      this.#time[this.#next] = (batch.firstTick + row * batch.stride) * periodS;
      let source = row * width;
      for (const columns of this.#lanes) {
        for (const column of columns.values()) {
          column[this.#next] = batch.values[source++] as number;
        }
      }
      this.#next = (this.#next + 1) % this.capacity;
      this.#length = Math.min(this.#length + 1, this.capacity);
    }
  }

  /** Newest value of a channel of lane 1, 2, …; NaN when there is none. */
  newest(channel: string, lane = 1): number {
    const column = this.#column(channel, lane);
    if (column === undefined || this.#length === 0) return Number.NaN;
    return column[this.#slot(this.#length - 1)] as number;
  }

  /** Index, counted from the oldest sample, of the first one at or after `timeS`. */
  firstAt(timeS: number): number {
    let low = 0;
    let high = this.#length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.#time[this.#slot(middle)] as number) < timeS) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Copies time from sample `first` on into `out`; returns how many were copied. */
  copyTime(first: number, out: Float64Array): number {
    return this.#copy(this.#time, first, out, 1);
  }

  /**
   * Copies a channel of lane 1, 2, … times `factor` from sample `first` on into `out`; NaN for a
   * channel or a lane that there is not.
   */
  copyChannel(channel: string, first: number, out: Float32Array, factor = 1, lane = 1): number {
    const column = this.#column(channel, lane);
    if (column !== undefined) return this.#copy(column, first, out, factor);
    const count = Math.min(this.#length - first, out.length);
    out.fill(Number.NaN, 0, count);
    return count;
  }

  #column(channel: string, lane: number): Float32Array | undefined {
    return this.#lanes[lane - 1]?.get(channel);
  }

  #setLanes(count: number): void {
    this.#lanes.length = Math.min(this.#lanes.length, count);
    while (this.#lanes.length < count) {
      const column = () => new Float32Array(this.capacity).fill(Number.NaN);
      this.#lanes.push(new Map(this.channels.map((name) => [name, column()])));
    }
  }

  #slot(index: number): number {
    return (this.#next - this.#length + index + this.capacity) % this.capacity;
  }

  #copy<T extends Float32Array | Float64Array>(
    column: T,
    first: number,
    out: T,
    factor: number,
  ): number {
    const count = Math.min(this.#length - first, out.length);
    let slot = this.#slot(first);
    for (let index = 0; index < count; index++) {
      out[index] = (column[slot] as number) * factor;
      slot = slot + 1 === this.capacity ? 0 : slot + 1;
    }
    return count;
  }
}
