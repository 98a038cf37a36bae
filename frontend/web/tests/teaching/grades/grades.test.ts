import "../../browserless";
import { beforeEach, describe, expect, test, vi } from "vitest";
import type { Grades, Submission } from "../../../src/core/api/course";

const {
  columns,
  gradeAll,
  grades,
  job,
  unfollow: leave,
  selection: picked,
  problem,
  selectedSubmission: shown,
  sumOf,
  ungraded,
} = await import("../../../src/teaching/grades/grades");
const { formatPoints } = await import("../../../src/core/widgets/criteria");
const { pageOfStudent } = await import("../../../src/core/api/course");
const { readPlace, writePlace } = await import("../../../src/runs/list/place");

const submitted = (exercise: string, points: number | null, why = ""): Submission =>
  ({
    exercise,
    problem: why,
    grade: points === null ? null : { points, max_points: 10, criteria: [] },
  }) as unknown as Submission;

const CLASS = {
  not_isolated: null,
  exercises: [
    { name: "one", number: 1, title: "One" },
    { name: "two", number: 2, title: "Two" },
    { name: "three", number: 3, title: "Three" },
  ],
  students: [
    { person: "p-1", name: "Ada", submissions: [submitted("three", 7.25), submitted("one", 10)] },
    { person: "p-2", name: "Bob", submissions: [submitted("one", null, "no bwrap")] },
  ],
} as Grades;

beforeEach(() => {
  leave();
  [grades.value, picked.value, job.value, problem.value] = [CLASS, null, null, ""];
});

describe("the table of grades", () => {
  test("has the exercises with a submission, in their order", () => {
    expect(columns.value.map(({ name }) => name)).toEqual(["one", "three"]);
  });

  test("sums the graded exercises only", () => {
    const [ada, bob] = CLASS.students as [Grades["students"][0], Grades["students"][0]];
    expect(sumOf(ada)).toEqual({ points: 17.25, maximum: 20 });
    expect(sumOf(bob)).toBeNull();
    expect(ungraded.value).toBe(1);
  });

  test("shows the selected student, and nothing if the student is gone", () => {
    picked.value = { person: "p-2", exercise: "one" };
    expect(shown.value?.submission.problem).toBe("no bwrap");
    picked.value = { person: "p-2", exercise: "three" };
    expect(shown.value).toBeNull();
  });

  test("points have at most two decimals", () => {
    expect([8, 8.5, 8.125, 1 / 3].map(formatPoints)).toEqual(["8", "8.5", "8.13", "0.33"]);
  });
});

describe("the addresses of the grades", () => {
  test("lead to the page and to the report of a student", () => {
    expect(readPlace("?grades=all")).toEqual({ kind: "grades" });
    expect(writePlace({ kind: "grades" }, "?leaderboard=fl")).toBe("?grades=all");
    expect(writePlace({ kind: "lab" }, "?grades=all")).toBe("");
    expect(pageOfStudent("p-1&x")).toBe("http://lab/api/v1/grades?format=html&person=p-1%26x");
  });
});

describe("grading", () => {
  test("is followed until it ends, and the grades are then read again", async () => {
    vi.useFakeTimers();
    const asked: string[] = [];
    const jobOf = (status: string) => ({ id: "g", kind: "grading", status, done: 1, total: 1 });
    const answers = [jobOf("running"), jobOf("done"), { ...CLASS, students: [] }];
    vi.stubGlobal("fetch", async (address: URL, { method }: { method: string }) => {
      asked.push(`${method} ${address.pathname}`);
      return { ok: true, status: 200, text: async () => JSON.stringify(answers.shift()) };
    });
    const grading = gradeAll(true);
    await vi.runAllTimersAsync();
    await grading;
    expect(asked).toEqual(["POST /api/v1/grades", "GET /api/v1/jobs/g", "GET /api/v1/grades"]);
    expect(grades.value?.students).toEqual([]);
    vi.useRealTimers();
  });

  test("reports why it is rejected", async () => {
    const refused = { detail: "Nothing was submitted yet", violations: [] };
    vi.stubGlobal("fetch", async () => ({
      ok: false,
      status: 409,
      text: async () => JSON.stringify(refused),
    }));
    await gradeAll(false);
    expect(problem.value).toContain("Nothing was submitted yet");
    expect(job.value).toBeNull();
  });
});
