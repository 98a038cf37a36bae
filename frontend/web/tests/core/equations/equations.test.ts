import katex from "katex";
import { describe, expect, it } from "vitest";
import { EQUATIONS, TOPICS } from "../../../src/core/equations/equations";
import { t } from "../../../src/core/text/t";

describe("equations", () => {
  it("are typeset without an error, each with its description", () => {
    for (const topic of TOPICS) {
      expect(t(`equations.topics.${topic}`)).toBeTruthy();
      for (const { tex, printed, note } of EQUATIONS[topic]) {
        expect(() => katex.renderToString(tex, { throwOnError: true })).not.toThrow();
        if (printed) expect(() => katex.renderToString(printed)).not.toThrow();
        if (note) expect(t(`equations.notes.${note}`)).toBeTruthy();
      }
    }
  });
});
