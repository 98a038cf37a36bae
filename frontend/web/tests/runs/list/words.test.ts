import "../../browserless";
import { expect, it } from "vitest";

it("the files of a record that started during a session state which time they use", async () => {
  const { formatLength } = await import("../../../src/runs/list/words");
  const run = { duration_s: 31.498, first_tick: 0, period_s: 0.001 };
  expect(formatLength(run)).toBe("31.5 s");
  expect(formatLength({ ...run, first_tick: 16_168 })).toBe("31.5 s, from session time 16.17 s");
});
