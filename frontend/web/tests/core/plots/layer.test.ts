import "../../browserless";
import { describe, expect, it, vi } from "vitest";
import { piecesOf } from "../../../src/core/plots/layer";

vi.mock("uplot", () => ({ default: class {} }));

describe("the scrolled layer of a plot", () => {
  const WIDTH = 7;
  /** The pixel since time 0 in each column of the canvas. */
  const roll = (left: number, first: number) =>
    piecesOf(left % WIDTH, first, WIDTH).flatMap(({ from, to, shift }) =>
      Array.from({ length: to - from }, (_, index) => [from + index, left + from + index - shift]),
    );

  it("contains every column of the plot once", () => {
    for (let left = 0; left < 2 * WIDTH; left++) {
      for (let first = 0; first <= WIDTH; first++) {
        const pixels = roll(left, first).map(([, pixel]) => pixel);
        expect(pixels).toEqual(
          Array.from({ length: WIDTH - first }, (_, index) => left + first + index),
        );
      }
    }
  });

  it("keeps each pixel in its column while time advances", () => {
    for (let left = 0; left < 3 * WIDTH; left++) {
      for (const [column, pixel] of roll(left, 0)) expect(column).toBe((pixel as number) % WIDTH);
    }
  });
});
