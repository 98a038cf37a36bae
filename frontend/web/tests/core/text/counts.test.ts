import { expect, it } from "vitest";
import { studiesText } from "../../../src/core/text/studies";

it("counts one sample in the singular", () => {
  const { difference, only, refused } = studiesText.studies;
  expect(difference("Peak", 1)).toBe("Peak, over 1 sample on which both finished");
  expect(difference("Peak", 40)).toContain("over 40 samples");
  expect(only(1, 2)).toBe("only the first succeeded: 1 sample; only the second: 2");
  expect(refused(1)).toBe("1 sample not run: incompatible settings");
});
