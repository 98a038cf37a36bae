import { expect, it } from "vitest";
import { errorHistoryOf } from "../../../src/teaching/course/outcome";

it("is extracted from a batch lane by lane", () => {
  const values = new Float32Array([0, 1, 0, 3, 0.5, 5, 0.5, 7]);
  const batch = { run: 1, firstTick: 0, stride: 1, count: 2, missed: 0, lanes: [1, 2], values };
  expect(errorHistoryOf(batch, 2)).toEqual({
    timeS: [0, 0.5],
    positionRad: [
      [1, 5],
      [3, 7],
    ],
  });
});
