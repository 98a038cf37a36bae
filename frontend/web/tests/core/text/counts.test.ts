import { expect, it } from "vitest";
import { t } from "../../../src/core/text/t";

it("counts one sample in the singular", () => {
  expect(t("studies.difference", { metric: "Peak", count: 1 })).toBe(
    "Peak, over 1 sample on which both finished",
  );
  expect(t("studies.difference", { metric: "Peak", count: 40 })).toContain("over 40 samples");
  expect(t("studies.only", { samples: t("studies.samples", { count: 1 }), second: 2 })).toBe(
    "only the first succeeded: 1 sample; only the second: 2",
  );
  expect(t("studies.refused", { count: 1 })).toBe("1 sample not run: incompatible settings");
});
