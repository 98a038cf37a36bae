import "../../browserless";
import { describe, expect, it } from "vitest";
import { unpack } from "../../../src/runs/replay/data";

/** Words of 4 bytes as planes: all lowest bytes, then the next. */
const planesOf = (words: Uint32Array) =>
  Uint8Array.from({ length: 4 * words.length }, (_, index) => {
    const plane = Math.floor(index / words.length);
    return ((words[index % words.length] as number) >>> (8 * plane)) & 255;
  });

describe("an array of a replay", () => {
  it("is float32, or differences in integer steps, and the lowest number marks a missing value", () => {
    const plain = new Uint32Array(new Float32Array([1.5, -2, Number.NaN]).buffer);
    expect([...unpack(planesOf(plain), [0, 3])]).toEqual([1.5, -2, Number.NaN]);
    // 300, −2, none, 7: the changes are 300, −302, −2³¹ + 2, and 2³¹ + 7, which wraps.
    const changes = new Uint32Array([600, 603, 2 ** 32 - 5, 2 ** 32 - 15]);
    const bytes = new Uint8Array([9, 9, ...planesOf(changes)]);
    expect([...unpack(bytes, [2, 4, 0.5])]).toEqual([150, -1, Number.NaN, 3.5]);
  });
});
