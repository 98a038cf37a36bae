import { describe, expect, it } from "vitest";
import { decodeBatch, HEADER_BYTES, MAGIC, StreamFormatError } from "../../src/stream/decoder";

function batch(
  rows: number[][],
  { magic = MAGIC, firstTick = 5n, count = rows.length, ids = [1], lanes = 0 } = {},
) {
  const width = rows[0]?.length ?? 0;
  const begin = HEADER_BYTES + 4 * ids.length;
  const message = new ArrayBuffer(begin + 4 * rows.length * width);
  const view = new DataView(message);
  view.setUint32(0, magic, true);
  view.setUint32(4, 3, true);
  view.setBigUint64(8, firstTick, true);
  view.setUint32(16, 5, true);
  view.setUint32(20, count, true);
  view.setUint32(24, 7, true);
  view.setUint32(28, lanes || ids.length, true);
  ids.forEach((id, index) => {
    view.setUint32(HEADER_BYTES + 4 * index, id, true);
  });
  rows.flat().forEach((value, index) => {
    view.setFloat32(begin + 4 * index, value, true);
  });
  return message;
}

describe("decodeBatch", () => {
  it("reads the header and the rows", () => {
    const decoded = decodeBatch(
      batch([
        [1, 2],
        [3, 4],
        [5, -6.5],
      ]),
      2,
    );
    expect(decoded).toMatchObject({ run: 3, firstTick: 5, stride: 5, count: 3, missed: 7 });
    expect([...decoded.values]).toEqual([1, 2, 3, 4, 5, -6.5]);
  });

  it("reads the lanes of each sample one after the other", () => {
    const rows = [
      [1, 2, 10, 20],
      [3, 4, 30, 40],
    ];
    const decoded = decodeBatch(batch(rows, { ids: [1, 3] }), 2);
    expect(decoded).toMatchObject({ count: 2, lanes: [1, 3] });
    expect([...decoded.values]).toEqual(rows.flat());
  });

  it("begins with the letters SVSA", () => {
    expect(new TextDecoder().decode(batch([[0]]).slice(0, 4))).toBe("SVSA");
  });

  it("keeps ticks beyond 32 bits", () => {
    expect(decodeBatch(batch([[1]], { firstTick: 2n ** 40n }), 1).firstTick).toBe(2 ** 40);
  });

  it("accepts a batch without samples", () => {
    expect(decodeBatch(batch([]), 13).count).toBe(0);
  });

  it.each([
    ["another magic number", batch([[1]], { magic: 1 }), 1],
    ["a count that does not fit", batch([[1]], { count: 2 }), 1],
    ["another number of channels", batch([[1, 2]]), 3],
    ["another number of lanes", batch([[1, 2]], { lanes: 2 }), 2],
    ["a cut header", new ArrayBuffer(12), 1],
  ])("refuses %s", (_, message, channels) => {
    expect(() => decodeBatch(message, channels)).toThrow(StreamFormatError);
  });
});
