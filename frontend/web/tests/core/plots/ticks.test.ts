import { describe, expect, it } from "vitest";
import { placeWords, timeStep } from "../../../src/core/plots/ticks";
import { text } from "../../../src/core/text/en";

describe("the numbers of the time axis", () => {
  const DIGIT_PX = 7;
  it.each([
    [280, 0.05, 1000.065],
    [280, 60, 3600],
    [420, 0.05, 12345.061],
    [420, 20, 1003.7],
    [900, 0.3, 1000.1],
    [900, 5, 9.99],
  ])("on %s px of %s s up to %s s stay whole and apart", (width, length, to) => {
    const from = to - length;
    const step = timeStep({ from, to }, width);
    const perStep = (step / length) * width;
    const words: [number, number][] = [];
    for (let index = Math.ceil(from / step - 1e-9); index * step <= to + 1e-9; index++) {
      const long = text.plots.timeTick(index * step).length * DIGIT_PX;
      const left = placeWords(((index * step - from) / length) * width, long, width, perStep);
      if (left !== null) words.push([left, left + long]);
    }
    expect(words.length).toBeGreaterThan(0);
    expect(words[0]?.[0]).toBeGreaterThanOrEqual(0);
    expect(words.at(-1)?.[1]).toBeLessThanOrEqual(width);
    words.slice(1).forEach(([left], index) => {
      expect(left).toBeGreaterThan((words[index] as [number, number])[1]);
    });
  });
});
