/** Arrays as `svsa_scene/replay_packing.py` packs them. */

/** First byte, number of values and, of a curve, the step of which they are multiples. */
export type Packed = [start: number, count: number, step?: number];

/** No number. */
const NONE = -(2 ** 31);

export function unpack(bytes: Uint8Array, [start, count, step]: Packed): Float32Array {
  const words = joinPlanes(bytes, start, count);
  return step === undefined ? new Float32Array(words.buffer) : addUp(words, step);
}

/** Words of 4 bytes of which all first bytes stand together, then all second ones, and so on. */
function joinPlanes(bytes: Uint8Array, start: number, count: number): Uint32Array<ArrayBuffer> {
  const joined = new Uint8Array(count * 4);
  for (let plane = 0; plane < 4; plane++) {
    const from = start + plane * count;
    for (let index = 0; index < count; index++) {
      joined[index * 4 + plane] = bytes[from + index] as number;
    }
  }
  return new Uint32Array(joined.buffer);
}

/** From differences, 0, −1, 1, −2 … written as 0, 1, 2, 3 …, to values. */
function addUp(changes: Uint32Array, step: number): Float32Array {
  const values = new Float32Array(changes.length);
  let whole = 0;
  changes.forEach((change, index) => {
    whole = (whole + ((change >>> 1) ^ -(change & 1))) | 0;
    values[index] = whole === NONE ? Number.NaN : whole * step;
  });
  return values;
}
