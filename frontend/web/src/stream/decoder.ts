/**
 * One binary message of the stream, little-endian:
 * u32 magic "SVSA", u32 run, u64 first tick, u32 stride, u32 count, u32 missed, u32 lanes,
 * then u32[lanes], which lane each is, then float32[count][lanes][channels]. Sample i is at tick
 * first + i·stride.
 */

export const HEADER_BYTES = 32;
export const MAGIC = 0x41535653;

export interface Batch {
  run: number;
  firstTick: number;
  stride: number;
  count: number;
  /** Samples that the server dropped for this client before this batch. */
  missed: number;
  /** Of every lane its id, as the session's state has it. */
  lanes: readonly number[];
  /** Row-major: values[(i * lanes.length + l) * channels + c]. */
  values: Float32Array;
}

export class StreamFormatError extends Error {
  override name = "StreamFormatError";
}

export function decodeBatch(message: ArrayBuffer, channels: number): Batch {
  if (message.byteLength < HEADER_BYTES) {
    throw new StreamFormatError(
      `a batch has ${message.byteLength} bytes: its header alone has ${HEADER_BYTES}`,
    );
  }
  const header = new DataView(message, 0, HEADER_BYTES);
  const magic = header.getUint32(0, true);
  if (magic !== MAGIC) {
    throw new StreamFormatError(`a batch begins with 0x${magic.toString(16)}: it must be "SVSA"`);
  }
  const count = header.getUint32(20, true);
  const laneCount = header.getUint32(28, true);
  const size = count * laneCount * channels;
  const begin = HEADER_BYTES + 4 * laneCount;
  const expected = begin + 4 * size;
  if (message.byteLength !== expected) {
    throw new StreamFormatError(
      `a batch has ${message.byteLength} bytes: ${count} samples of ${laneCount} lanes of ${channels} channels have ${expected}`,
    );
  }
  return {
    run: header.getUint32(4, true),
    firstTick: Number(header.getBigUint64(8, true)),
    stride: header.getUint32(16, true),
    count,
    missed: header.getUint32(24, true),
    lanes: Array.from(new Uint32Array(message, HEADER_BYTES, laneCount)),
    values: new Float32Array(message, begin, size),
  };
}
