import "../../browserless";
import { beforeEach, describe, expect, it, vi } from "vitest";

const putLaw = vi.fn();
vi.mock("../../../src/core/api/course", async (load) => ({ ...(await load<object>()), putLaw }));

const { findFault, MAX_BYTES } = await import("../../../src/core/widgets/lawtext");
const lesson = await import("../../../src/teaching/course/lesson");
const { RefusedError } = await import("../../../src/core/api/errors");

beforeEach(() => {
  putLaw.mockReset();
  lesson.exercise.value = { name: "own-law", law: null } as never;
  lesson.problem.value = "";
});

describe("the text of a law", () => {
  it("is measured in bytes, as on the server", () => {
    expect(findFault("é".repeat(MAX_BYTES / 2))).toBe("");
    expect(findFault(`${"é".repeat(MAX_BYTES / 2)}#`)).toContain(`${MAX_BYTES + 1} bytes`);
  });

  it("is tested and saved by the server, which reports the result", async () => {
    const kept = { name: "own-law", law: { text: "law", verdict: "held" } };
    putLaw.mockResolvedValue(kept);
    await lesson.tryLaw("law");
    expect(putLaw).toHaveBeenCalledWith("own-law", "law");
    expect(lesson.exercise.value).toBe(kept);
  });

  it("is not saved if it is rejected, with the reason", async () => {
    const before = lesson.exercise.value;
    putLaw.mockRejectedValue(new RefusedError(409, "It was submitted."));
    await lesson.tryLaw("law");
    expect(lesson.exercise.value).toBe(before);
    expect(lesson.problem.value).toContain("It was submitted.");
    expect(lesson.isBusy.value).toBe("");
  });
});
