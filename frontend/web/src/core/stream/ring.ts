/** The samples that the page requests, derives and stores. */
import type { Batch } from "./decoder";
import { type DerivedName, derive, derivedFrom, orMissing } from "./derived";
import { TimeRing } from "./times";

export const RATE_HZ = 200;
/** Seconds of past that follow the first samples; the server stores no more. */
export const HISTORY_S = 20;
export const MAX_WINDOW_S = 60;

// The newest samples of a session, one column per channel and lane, in arrays that are never
// reallocated. `setLanes` sets the lanes and their order; each batch contains the ids of its lanes:
// a lane keeps its past at any position, has NaN while it did not exist, and is removed with its
// past. Derived channels are stored with the channels they come from. Samples that were not sent to
// a slow client are a gap: its first and last sample are stored as NaN, so that no reader connects
// the samples before and after it.

/**
 * A part of one column without copying: sample i is at (start + i) mod the length of the columns.
 */
export interface Segment {
  time: Float64Array;
  values: Float32Array;
  start: number;
  count: number;
  /** Number of the first sample since the beginning; a sample keeps its number. */
  number: number;
}

interface Lane {
  id: number;
  columns: Map<string, Float32Array>;
}

export class SampleRing extends TimeRing {
  #channels: readonly string[];
  #lanes: Lane[] = [];
  #changesOfPast = 0;

  /**
   * @param lanes ids of the lanes
   */
  constructor(capacity: number, channels: readonly string[], lanes: readonly number[] = []) {
    super(capacity);
    this.#channels = channels;
    this.setLanes(lanes);
  }

  get channels(): readonly string[] {
    return this.#channels;
  }

  /** Number of lanes. */
  get lanes(): number {
    return this.#lanes.length;
  }

  /** Set the lanes, by their ids, in this order. */
  setLanes(ids: readonly number[]): void {
    const existing = new Map(this.#lanes.map(({ id, columns }) => [id, columns]));
    const blank = () => new Map(this.#columns.map((name) => [name, this.#blank()]));
    this.#lanes = ids.map((id) => ({ id, columns: existing.get(id) ?? blank() }));
  }

  /** Add the newest samples; stored samples of the same time and later are replaced. */
  append(batch: Batch, periodS: number): void {
    this.dropFrom(batch.firstTick * periodS);
    this.#markGap(batch, periodS);
    const derived = derivedFrom(this.#channels);
    const width = this.#channels.length;
    const batchIndices = this.#lanes.map(({ id }) => batch.lanes.indexOf(id));
    const skipped = Math.max(0, batch.count - this.capacity);
    for (let row = skipped; row < batch.count; row++) {
      for (const [lane, { columns }] of this.#lanes.entries()) {
        const batchIndex = batchIndices[lane] as number;
        let source = (row * batch.lanes.length + batchIndex) * width;
        for (const channel of this.#channels) {
          const value = batchIndex < 0 ? Number.NaN : (batch.values[source++] as number);
          (columns.get(channel) as Float32Array)[this.head] = orMissing(channel, value);
        }
        for (const name of derived) this.#derive(columns, name);
      }
      this.advance(batch.firstTick + row * batch.stride, batch.stride, periodS);
    }
  }

  /** Increases when samples older than the newest change: what was drawn of them is outdated. */
  get changesOfPast(): number {
    return this.#changesOfPast;
  }

  /** Insert samples of the past; samples that are newer than all of them stay. */
  insert(batch: Batch, periodS: number): void {
    this.#changesOfPast++;
    const first = this.lowerBound((batch.firstTick + batch.count * batch.stride) * periodS);
    const times = this.timesFrom(first);
    const columns = this.#lanes.flatMap((lane) => [...lane.columns.values()]);
    const values = columns.map((column) => {
      const copy = new Float32Array(times.length);
      this.copyOut(column, first, copy, 1);
      return copy;
    });
    this.append(batch, periodS);
    for (const [index, [timeS, dueTick]] of times.entries()) {
      for (const [place, column] of columns.entries())
        column[this.head] = values[place]?.[index] as number;
      this.advanceTo(timeS, dueTick);
    }
  }

  /** The channels streamed, and those derived from them. */
  get #columns(): readonly string[] {
    return [...this.#channels, ...derivedFrom(this.#channels)];
  }

  #derive(columns: ReadonlyMap<string, Float32Array>, name: DerivedName): void {
    const value = (channel: string) => (columns.get(channel) as Float32Array)[this.head] as number;
    (columns.get(name) as Float32Array)[this.head] = derive(name, value);
  }

  /** Create a ring for other channels that begins with the samples of this one. */
  withChannels(channels: readonly string[]): SampleRing {
    const other = this.copy();
    other.#channels = channels;
    for (const { columns } of other.#lanes) {
      const selectedColumns = other.#columns;
      for (const name of [...columns.keys()])
        if (!selectedColumns.includes(name)) columns.delete(name);
      for (const name of selectedColumns) if (!columns.has(name)) columns.set(name, this.#blank());
    }
    return other;
  }

  copy(): SampleRing {
    const other = new SampleRing(this.capacity, this.#channels);
    other.copyTimesFrom(this);
    other.#lanes = this.#lanes.map(({ id, columns }) => ({
      id,
      columns: new Map([...columns].map(([name, column]) => [name, column.slice()])),
    }));
    return other;
  }

  /**
   * Take what is missing here from another ring: channels, and samples up to the newest; again what
   * has arrived since then.
   */
  completeFrom(source: SampleRing): void {
    this.#changesOfPast++;
    const known = this.copy();
    this.#channels = [...new Set([...this.#channels, ...source.#channels])];
    const isLate = (timeS: number) =>
      timeS < this.newestTime && this.timeAt(this.lowerBound(timeS)) !== timeS;
    const late = source.timesFrom(0).filter(([timeS]) => isLate(timeS));
    const times = [...this.timesFrom(0), ...late].sort(([first], [second]) => first - second);
    const blank = () => new Map(this.#columns.map((name) => [name, this.#blank()]));
    this.#lanes = this.#lanes.map(({ id }) => ({ id, columns: blank() }));
    const places = this.#lanes.map(({ id }) => source.#lanes.findIndex((lane) => lane.id === id));
    this.clear();
    for (const [timeS, dueTick] of times) {
      const [own, other] = [known.#indexAt(timeS), source.#indexAt(timeS)];
      for (const [index, { columns }] of this.#lanes.entries()) {
        for (const [name, column] of columns) {
          const value = known.valueAt(name, own, index + 1);
          const place = (places[index] as number) + 1;
          column[this.head] = Number.isNaN(value) ? source.valueAt(name, other, place) : value;
        }
      }
      this.advanceTo(timeS, dueTick);
    }
  }

  /** Index of the sample at exactly this time; -1 if there is none. */
  #indexAt(timeS: number): number {
    const index = this.lowerBound(timeS);
    return this.timeAt(index) === timeS ? index : -1;
  }

  /** Newest value of a channel of lane 1, 2, …; NaN if there is none. */
  newest(channel: string, lane = 1): number {
    return this.valueAt(channel, this.length - 1, lane);
  }

  /** Value of a sample, counted from the oldest one; NaN if there is none. */
  valueAt(channel: string, index: number, lane = 1): number {
    const column = this.#column(channel, lane);
    const isStored = column !== undefined && index >= 0 && index < this.length;
    return isStored ? (column[this.slot(index)] as number) : Number.NaN;
  }

  /** Time of the first sample with a value of a channel and lane, s; NaN if there is none. */
  firstTimeOf(channel: string, lane: number): number {
    for (let index = 0; index < this.length; index++) {
      if (!Number.isNaN(this.valueAt(channel, index, lane))) return this.timeAt(index);
    }
    return Number.NaN;
  }

  /**
   * Samples from index `first` up to before `end` of a channel and lane; null if it does not exist.
   */
  segment(channel: string, lane: number, first: number, end: number): Segment | null {
    const values = this.#column(channel, lane);
    if (values === undefined) return null;
    const from = Math.max(0, first);
    const count = Math.max(0, Math.min(end, this.length) - from);
    return {
      time: this.time,
      values,
      start: this.slot(from),
      count,
      number: this.sampleNumber(from),
    };
  }

  /**
   * Copy a channel of lane 1, 2, … times `factor` from sample `first` on into `out`; NaN for a
   * missing channel or lane.
   */
  copyChannel(
    channel: string,
    first: number,
    out: Float32Array | Float64Array,
    factor = 1,
    lane = 1,
  ): number {
    const column = this.#column(channel, lane);
    if (column !== undefined) return this.copyOut(column, first, out, factor);
    const count = Math.min(this.length - first, out.length);
    out.fill(Number.NaN, 0, count);
    return count;
  }

  #column(channel: string, lane: number): Float32Array | undefined {
    return this.#lanes[lane - 1]?.columns.get(channel);
  }

  #blank(): Float32Array {
    return new Float32Array(this.capacity).fill(Number.NaN);
  }

  /** The first and the last missing sample before a batch, if any. */
  #markGap({ firstTick, stride }: Batch, periodS: number): void {
    const expectedTick = this.expectedTick ?? firstTick;
    if (expectedTick >= firstTick) return;
    this.#appendBlank(expectedTick, stride, periodS);
    if (firstTick - stride > expectedTick) this.#appendBlank(firstTick - stride, stride, periodS);
  }

  #appendBlank(tick: number, stride: number, periodS: number): void {
    for (const { columns } of this.#lanes) {
      for (const column of columns.values()) column[this.head] = Number.NaN;
    }
    this.advance(tick, stride, periodS);
  }
}
