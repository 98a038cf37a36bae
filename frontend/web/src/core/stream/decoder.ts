/** Decodes the binary messages of the stream, whose layout the greeting defines. */
import type { Hello } from "../api/types";

export type StreamDescription = Pick<Hello, "batch"> & { channels: readonly unknown[] };
type Layout = Hello["batch"];
type Field = Layout["header"][number];
type FieldName = Field["name"];

export interface Batch {
  run: number;
  firstTick: number;
  stride: number;
  count: number;
  /** Samples that the server dropped for this client before this batch. */
  missed: number;
  /** The id of each lane, as in the session's state. */
  lanes: readonly number[];
  /** Row-major: values[(i * lanes.length + l) * channels + c]. */
  values: Float32Array;
}

export class StreamFormatError extends Error {
  override name = "StreamFormatError";
}

const NUMBERS: Record<
  Exclude<Field["type"], "4 bytes">,
  (view: DataView, byte: number) => number
> = {
  uint32: (view, byte) => view.getUint32(byte, true),
  uint64: (view, byte) => Number(view.getBigUint64(byte, true)),
};
const ARRAYS = {
  uint32: Uint32Array,
  float32: Float32Array,
} satisfies Record<Layout["lane_id" | "value"], unknown>;

export class BatchDecoder {
  readonly #layout: Layout;
  readonly #channels: number;
  readonly #fields: ReadonlyMap<FieldName, Field>;

  constructor({ batch, channels }: StreamDescription) {
    this.#layout = batch;
    this.#channels = channels.length;
    this.#fields = new Map(batch.header.map((field) => [field.name, field]));
  }

  /** Throws `StreamFormatError` if it is not a batch with this number of channels. */
  decode(message: ArrayBuffer): Batch {
    const { header_bytes: headerBytes, lane_id, value } = this.#layout;
    if (message.byteLength < headerBytes) {
      throw new StreamFormatError(
        `a batch has ${message.byteLength} bytes: its header alone has ${headerBytes}`,
      );
    }
    this.#checkMagic(message);
    const header = new DataView(message, 0, headerBytes);
    const count = this.#read(header, "count");
    const lanes = this.#read(header, "lanes");
    const size = count * lanes * this.#channels;
    const begin = headerBytes + ARRAYS[lane_id].BYTES_PER_ELEMENT * lanes;
    const expected = begin + ARRAYS[value].BYTES_PER_ELEMENT * size;
    if (message.byteLength !== expected) {
      throw new StreamFormatError(
        `a batch has ${message.byteLength} bytes: ${count} samples of ${lanes} lanes of ${this.#channels} channels have ${expected}`,
      );
    }
    return {
      run: this.#read(header, "run"),
      firstTick: this.#read(header, "first_tick"),
      stride: this.#read(header, "stride"),
      count,
      missed: this.#read(header, "missed"),
      lanes: Array.from(new ARRAYS[lane_id](message, headerBytes, lanes)),
      values: new ARRAYS[value](message, begin, size),
    };
  }

  #checkMagic(message: ArrayBuffer): void {
    const { magic } = this.#layout;
    const bytes = new Uint8Array(message, this.#field("magic").byte, magic.length);
    const prefix = new TextDecoder("latin1").decode(bytes);
    if (prefix !== magic) {
      throw new StreamFormatError(`a batch begins with "${prefix}": it must be "${magic}"`);
    }
  }

  #read(header: DataView, name: Exclude<FieldName, "magic">): number {
    const { type, byte } = this.#field(name);
    if (type === "4 bytes") throw new StreamFormatError(`a batch's ${name} is no number`);
    return NUMBERS[type](header, byte);
  }

  #field(name: FieldName): Field {
    const field = this.#fields.get(name);
    if (field === undefined) throw new StreamFormatError(`a batch's header has no ${name}`);
    return field;
  }
}
