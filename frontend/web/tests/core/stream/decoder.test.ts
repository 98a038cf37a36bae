import { describe, expect, it } from "vitest";
import {
  BatchDecoder,
  type StreamDescription,
  StreamFormatError,
} from "../../../src/core/stream/decoder";

const LAYOUT: StreamDescription["batch"] = {
  magic: "SVSA",
  header_bytes: 32,
  header: [
    { name: "magic", type: "4 bytes", byte: 0 },
    { name: "run", type: "uint32", byte: 4 },
    { name: "first_tick", type: "uint64", byte: 8 },
    { name: "stride", type: "uint32", byte: 16 },
    { name: "count", type: "uint32", byte: 20 },
    { name: "missed", type: "uint32", byte: 24 },
    { name: "lanes", type: "uint32", byte: 28 },
  ],
  lane_id: "uint32",
  value: "float32",
};

const decode = (message: ArrayBuffer, channels: number, layout = LAYOUT) =>
  new BatchDecoder({ batch: layout, channels: Array(channels).fill({}) }).decode(message);

function batch(
  rows: number[][],
  { magic = "SVSA", firstTick = 5, count = rows.length, ids = [1], lanes = 0 } = {},
  { header_bytes: headerBytes, header } = LAYOUT,
) {
  const begin = headerBytes + 4 * ids.length;
  const message = new ArrayBuffer(begin + 4 * rows.length * (rows[0]?.length ?? 0));
  const view = new DataView(message);
  const numbers = { run: 3, stride: 5, count, missed: 7, lanes: lanes || ids.length };
  for (const { name, byte } of header) {
    if (name === "magic") new Uint8Array(message, byte).set(new TextEncoder().encode(magic));
    else if (name === "first_tick") view.setBigUint64(byte, BigInt(firstTick), true);
    else view.setUint32(byte, numbers[name], true);
  }
  ids.forEach((id, index) => {
    view.setUint32(headerBytes + 4 * index, id, true);
  });
  rows.flat().forEach((value, index) => {
    view.setFloat32(begin + 4 * index, value, true);
  });
  return message;
}

describe("a batch of the stream", () => {
  it("reads the header and the rows", () => {
    const decoded = decode(
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

  it("reads the lanes of each sample in order", () => {
    const rows = [
      [1, 2, 10, 20],
      [3, 4, 30, 40],
    ];
    const decoded = decode(batch(rows, { ids: [1, 3] }), 2);
    expect(decoded).toMatchObject({ count: 2, lanes: [1, 3] });
    expect([...decoded.values]).toEqual(rows.flat());
  });

  it("is read with the field positions of the greeting", () => {
    const moved = {
      ...LAYOUT,
      header_bytes: 40,
      header: LAYOUT.header.map((field) => ({ ...field, byte: 36 - field.byte })),
    };
    const first = moved.header.find(({ name }) => name === "first_tick") as { byte: number };
    first.byte = 24;
    const values = [[1, 2]];
    const decoded = decode(batch(values, { ids: [4] }, moved), 2, moved);
    expect(decoded).toMatchObject({ run: 3, firstTick: 5, stride: 5, count: 1, missed: 7 });
    expect([decoded.lanes, ...decoded.values]).toEqual([[4], 1, 2]);
    expect(() => decode(batch(values), 2, moved)).toThrow(StreamFormatError);
  });

  it("keeps ticks beyond 32 bits", () => {
    expect(decode(batch([[1]], { firstTick: 2 ** 40 }), 1).firstTick).toBe(2 ** 40);
  });

  it("accepts a batch without samples", () => {
    expect(decode(batch([]), 13).count).toBe(0);
  });

  it.each([
    ["another magic number", batch([[1]], { magic: "AVSA" }), 1],
    ["a count that does not fit", batch([[1]], { count: 2 }), 1],
    ["another number of channels", batch([[1, 2]]), 3],
    ["another number of lanes", batch([[1, 2]], { lanes: 2 }), 2],
    ["a cut header", new ArrayBuffer(12), 1],
  ])("rejects %s", (_, message, channels) => {
    expect(() => decode(message, channels)).toThrow(StreamFormatError);
  });
});
