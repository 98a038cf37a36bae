/** A ring of sample times: position of the newest, and lookup by time. */

/** Tolerance for the time of a sample, s. */
const TIME_TOLERANCE_S = 0.02;

export class TimeRing {
  readonly capacity: number;
  #time: Float64Array;
  /** The tick at which the sample after this one is expected. */
  #due: Float64Array;
  #next = 0;
  #length = 0;
  #total = 0;

  constructor(capacity: number) {
    this.capacity = capacity;
    this.#time = new Float64Array(capacity);
    this.#due = new Float64Array(capacity);
  }

  get length(): number {
    return this.#length;
  }

  /** Time of the oldest sample, s; NaN when there is none. */
  get oldestTime(): number {
    return this.timeAt(0);
  }

  /** Time of the newest sample, s; NaN when there is none. */
  get newestTime(): number {
    return this.timeAt(this.#length - 1);
  }

  clear(): void {
    this.#next = 0;
    this.#length = 0;
  }

  /** Time of a sample, counted from the oldest one, s; NaN when there is none. */
  timeAt(index: number): number {
    const isStored = index >= 0 && index < this.#length;
    return isStored ? (this.#time[this.slot(index)] as number) : Number.NaN;
  }

  /** Index, counted from the oldest sample, of the first one at or after `timeS`. */
  lowerBound(timeS: number): number {
    let low = 0;
    let high = this.#length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.#time[this.slot(middle)] as number) < timeS) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Index of the sample nearest to a time; -1 if there is none. */
  nearestTo(timeS: number): number {
    if (this.#length === 0) return -1;
    const after = Math.min(this.lowerBound(timeS), this.#length - 1);
    const before = Math.max(0, after - 1);
    return timeS - this.timeAt(before) <= this.timeAt(after) - timeS ? before : after;
  }

  /** Index of the sample at a time, the nearest; -1 before the oldest and after the newest. */
  sampleAt(timeS: number): number {
    const isStored =
      timeS >= this.oldestTime - TIME_TOLERANCE_S && timeS <= this.newestTime + TIME_TOLERANCE_S;
    return isStored ? this.nearestTo(timeS) : -1;
  }

  /** Copies time from sample `first` on into `out`; returns how many were copied. */
  copyTime(first: number, out: Float64Array): number {
    return this.copyOut(this.#time, first, out, 1);
  }

  /** Position of the next sample. */
  protected get head(): number {
    return this.#next;
  }

  /** The tick at which the next sample is expected; null before the first. */
  protected get expectedTick(): number | null {
    return this.#length === 0 ? null : (this.#due[this.slot(this.#length - 1)] as number);
  }

  /** All slots, in storage order. */
  protected get time(): Float64Array {
    return this.#time;
  }

  /** Number of a sample since the beginning, from its index counted from the oldest. */
  protected sampleNumber(index: number): number {
    return this.#total - this.#length + index;
  }

  protected copyTimesFrom(other: TimeRing): void {
    this.#time = other.#time.slice();
    this.#due = other.#due.slice();
    this.#next = other.#next;
    this.#length = other.#length;
    this.#total = other.#total;
  }

  protected advance(tick: number, stride: number, periodS: number): void {
    this.advanceTo(tick * periodS, tick + stride);
  }

  /** Times of the samples from index `first` on, and the ticks at which the next ones are expected. */
  protected timesFrom(first: number): readonly (readonly [timeS: number, dueTick: number])[] {
    return Array.from({ length: this.#length - first }, (_, index) => {
      const slot = this.slot(first + index);
      return [this.#time[slot] as number, this.#due[slot] as number] as const;
    });
  }

  protected advanceTo(timeS: number, dueTick: number): void {
    this.#time[this.#next] = timeS;
    this.#due[this.#next] = dueTick;
    this.#next = (this.#next + 1) % this.capacity;
    this.#length = Math.min(this.#length + 1, this.capacity);
    this.#total++;
  }

  protected dropFrom(timeS: number): void {
    if (!(timeS <= this.newestTime)) return;
    const dropped = this.#length - this.lowerBound(timeS);
    this.#next = (this.#next - dropped + this.capacity) % this.capacity;
    this.#length -= dropped;
    this.#total -= dropped;
  }

  /** Position of a sample counted from the oldest. */
  protected slot(index: number): number {
    return (this.#next - this.#length + index + this.capacity) % this.capacity;
  }

  protected copyOut(
    column: Float32Array | Float64Array,
    first: number,
    out: Float32Array | Float64Array,
    factor: number,
  ): number {
    const count = Math.min(this.#length - first, out.length);
    let slot = this.slot(first);
    for (let index = 0; index < count; index++) {
      out[index] = (column[slot] as number) * factor;
      slot = slot + 1 === this.capacity ? 0 : slot + 1;
    }
    return count;
  }
}
