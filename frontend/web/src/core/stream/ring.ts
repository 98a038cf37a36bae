/** The samples that the page requests, derives and keeps. */
import type { StreamedName } from "../api/types";
import type { Batch } from "./decoder";
import { TimeRing } from "./times";

export const RATE_HZ = 200;
/** Sent at first; the server holds no more. */
export const HISTORY_S = 20;
export const LONGEST_WINDOW_S = 60;

// Channels that the page derives from two that are streamed: `of` less `less`, sample by sample.

const DERIVED = {
  /** ė = q̇_d − q̇. */
  velocity_error_rad_per_s: { of: "velocity_reference_rad_per_s", less: "velocity_rad_per_s" },
} as const satisfies Record<string, { of: StreamedName; less: StreamedName }>;

export type DerivedName = keyof typeof DERIVED;
const NAMES = Object.keys(DERIVED) as DerivedName[];

/** What can be derived from these channels. */
const derivedFrom = (channels: readonly string[]): DerivedName[] =>
  NAMES.filter(
    (name) => channels.includes(DERIVED[name].of) && channels.includes(DERIVED[name].less),
  );

/** The channels to be streamed for a channel: itself, or those it is derived from. */
export function sourcesOf(channel: string): string[] {
  if (!Object.hasOwn(DERIVED, channel)) return [channel];
  const { of, less } = DERIVED[channel as DerivedName];
  return [of, less];
}

// The newest samples of a session, one column a channel and lane, in arrays that are never
// reallocated. `arrange` sets the lanes and their order; whose samples a batch
// has, the batch says, by the ids of the lanes: a lane takes its past along wherever it stands, has
// no number where it was not there, and goes with its past.
//
// Derived channels are stored with the channels they come from.
//
// Samples that a slow client was not sent are a gap: the first and the last of them stand in their
// places as samples without numbers, and nothing between them, so that no reader of the ring joins
// what lies before to what lies after.

/** A piece of one column where it lies: sample i is at (start + i) mod the columns' length. */
export interface Segment {
  time: Float64Array;
  values: Float32Array;
  start: number;
  count: number;
  /** Which sample since the beginning the first one is; the same sample keeps its number. */
  number: number;
}

interface Lane {
  id: number;
  columns: Map<string, Float32Array>;
}

export class SampleRing extends TimeRing {
  #channels: readonly string[];
  #lanes: Lane[] = [];

  /** @param lanes their ids */
  constructor(capacity: number, channels: readonly string[], lanes: readonly number[] = []) {
    super(capacity);
    this.#channels = channels;
    this.arrange(lanes);
  }

  get channels(): readonly string[] {
    return this.#channels;
  }

  /** How many lanes there are. */
  get lanes(): number {
    return this.#lanes.length;
  }

  /** These lanes from now on, by their ids, in this order. */
  arrange(ids: readonly number[]): void {
    const held = new Map(this.#lanes.map(({ id, columns }) => [id, columns]));
    const blank = () => new Map(this.#columns.map((name) => [name, this.#blank()]));
    this.#lanes = ids.map((id) => ({ id, columns: held.get(id) ?? blank() }));
  }

  /** Adds the newest samples; stored samples of the same time and later are replaced. */
  append(batch: Batch, periodS: number): void {
    this.dropFrom(batch.firstTick * periodS);
    this.#markGap(batch, periodS);
    const derived = derivedFrom(this.#channels);
    const width = this.#channels.length;
    const places = this.#lanes.map(({ id }) => batch.lanes.indexOf(id));
    const skipped = Math.max(0, batch.count - this.capacity);
    for (let row = skipped; row < batch.count; row++) {
      for (const [lane, { columns }] of this.#lanes.entries()) {
        const place = places[lane] as number;
        let source = (row * batch.lanes.length + place) * width;
        for (const channel of this.#channels) {
          const value = place < 0 ? Number.NaN : (batch.values[source++] as number);
          (columns.get(channel) as Float32Array)[this.head] = value;
        }
        for (const name of derived) this.#derive(columns, name);
      }
      this.advance(batch.firstTick + row * batch.stride, batch.stride, periodS);
    }
  }

  /** The channels streamed, and those that are derived from them. */
  get #columns(): readonly string[] {
    return [...this.#channels, ...derivedFrom(this.#channels)];
  }

  #derive(columns: ReadonlyMap<string, Float32Array>, name: DerivedName): void {
    const { of, less } = DERIVED[name];
    const value = (channel: string) => (columns.get(channel) as Float32Array)[this.head] as number;
    (columns.get(name) as Float32Array)[this.head] = value(of) - value(less);
  }

  /** A ring for other channels that begins with what this one holds of them. */
  reselect(channels: readonly string[]): SampleRing {
    const other = this.copy();
    other.#channels = channels;
    for (const { columns } of other.#lanes) {
      const kept = other.#columns;
      for (const name of [...columns.keys()]) if (!kept.includes(name)) columns.delete(name);
      for (const name of kept) if (!columns.has(name)) columns.set(name, this.#blank());
    }
    return other;
  }

  copy(): SampleRing {
    const other = new SampleRing(this.capacity, this.#channels);
    other.adoptTimes(this);
    other.#lanes = this.#lanes.map(({ id, columns }) => ({
      id,
      columns: new Map([...columns].map(([name, column]) => [name, column.slice()])),
    }));
    return other;
  }

  /** Takes over the channels that it lacks, where the other ring has a sample of the same time. */
  adopt(source: SampleRing): void {
    const known = this.#columns;
    const missing = source.#columns.filter((name) => !known.includes(name));
    this.#channels = [...new Set([...this.#channels, ...source.#channels])];
    for (const { id, columns } of this.#lanes) {
      const lane = source.#lanes.findIndex((other) => other.id === id) + 1;
      for (const name of missing) {
        const column = this.#blank();
        for (let index = 0; index < this.length; index++) {
          const time = this.timeAt(index);
          const at = source.firstAt(time);
          if (source.timeAt(at) === time) {
            column[this.slot(index)] = source.valueAt(name, at, lane);
          }
        }
        columns.set(name, column);
      }
    }
  }

  /** Newest value of a channel of lane 1, 2, …; NaN when there is none. */
  newest(channel: string, lane = 1): number {
    return this.valueAt(channel, this.length - 1, lane);
  }

  /** Value of a sample, counted from the oldest one; NaN when there is none. */
  valueAt(channel: string, index: number, lane = 1): number {
    const column = this.#column(channel, lane);
    const isHeld = column !== undefined && index >= 0 && index < this.length;
    return isHeld ? (column[this.slot(index)] as number) : Number.NaN;
  }

  /** Time of the first sample that has a number of a channel and lane, s; NaN where none has. */
  beginningOf(channel: string, lane: number): number {
    for (let index = 0; index < this.length; index++) {
      if (!Number.isNaN(this.valueAt(channel, index, lane))) return this.timeAt(index);
    }
    return Number.NaN;
  }

  /** Samples from index `first` up to before `end` of a channel and lane; null where it is not. */
  segment(channel: string, lane: number, first: number, end: number): Segment | null {
    const values = this.#column(channel, lane);
    if (values === undefined) return null;
    const from = Math.max(0, first);
    const count = Math.max(0, Math.min(end, this.length) - from);
    return { time: this.time, values, start: this.slot(from), count, number: this.numberOf(from) };
  }

  /**
   * Copies a channel of lane 1, 2, … times `factor` from sample `first` on into `out`; NaN for a
   * channel or a lane that there is not.
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

  /** The first and the last sample that are missing before a batch, if any. */
  #markGap({ firstTick, stride }: Batch, periodS: number): void {
    const due = this.due ?? firstTick;
    if (due >= firstTick) return;
    this.#appendBlank(due, stride, periodS);
    if (firstTick - stride > due) this.#appendBlank(firstTick - stride, stride, periodS);
  }

  #appendBlank(tick: number, stride: number, periodS: number): void {
    for (const { columns } of this.#lanes) {
      for (const column of columns.values()) column[this.head] = Number.NaN;
    }
    this.advance(tick, stride, periodS);
  }
}
