import "../../browserless";
import { describe, expect, it } from "vitest";
import { nameMarks, rankOf } from "../../../src/core/plots/eventlines";

const mark = (x: number, kind: string, room = 80) => ({ x, room, rank: rankOf(kind) });

describe("the labels of event lines", () => {
  it("are on the right, or on the left at the end of the plots", () => {
    expect(nameMarks([mark(100, "law"), mark(580, "law")], 600)).toEqual(["right", "left"]);
  });

  it("include a fault that occurs at the same time as a load", () => {
    const marks = [mark(300, "fault"), mark(300, "load_on")];
    expect(nameMarks(marks, 600)).toEqual(["right", "left"]);
    const narrow = [mark(300, "load_off"), mark(300, "fault"), mark(300, "law")];
    expect(nameMarks(narrow, 390)).toEqual(["left", "right", null]);
    expect(nameMarks([mark(60, "load_on", 120), mark(60, "fault", 120)], 190)).toEqual([
      null,
      "right",
    ]);
  });

  it("do not overlap, and the newest of equal ones is shown", () => {
    const marks = [mark(100, "gains"), mark(130, "gains"), mark(160, "gains")];
    expect(nameMarks(marks, 600)).toEqual(["left", null, "right"]);
  });
});
