import "../../browserless";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { RefusedError, UnansweredError } from "../../../src/core/api/errors";

const api = { readJob: vi.fn(), listJobs: vi.fn(), stopJob: vi.fn() };
vi.doMock("../../../src/core/api/jobs", async (load) => ({ ...(await load<object>()), ...api }));
const { followJobs } = await import("../../../src/core/jobs/follow");
const { createPoll: polling } = await import("../../../src/core/jobs/poll");

const errors: unknown[] = [];
const unanswered = new UnansweredError(new TypeError("Failed to fetch"));
const gone = new RefusedError(404, "There is no job a here");
const stateOf = (status: string) => ({ id: "a", kind: "grading", status });
let ends: number;
const followed = () =>
  followJobs(
    "grading",
    (error) => errors.push(error),
    () => ends++,
  );

beforeEach(() => {
  vi.useFakeTimers();
  for (const call of Object.values(api)) call.mockReset();
  errors.length = 0;
  ends = 0;
});
afterEach(() => vi.useRealTimers());

test("a silent server is polled again, with a message until it answers", async () => {
  const { job, follow } = followed();
  api.readJob.mockRejectedValue(unanswered);
  const ended = follow(stateOf("waiting") as never);
  await vi.advanceTimersByTimeAsync(60_000);
  expect(new Set(errors)).toEqual(new Set([unanswered]));
  api.readJob.mockResolvedValueOnce(stateOf("running")).mockResolvedValue(stateOf("done"));
  await vi.advanceTimersByTimeAsync(700);
  expect([errors.at(-1), job.value?.status]).toEqual([null, "running"]);
  await vi.runAllTimersAsync();
  await ended;
  expect([job.value?.status, ends]).toEqual(["done", 1]);
});

test("a job unknown to the server is removed, with the reason", async () => {
  const { job, follow } = followed();
  api.readJob.mockRejectedValue(gone);
  await follow(stateOf("running") as never);
  expect([job.value, errors, ends]).toEqual([null, [gone], 0]);
});

test("an error message that was set meanwhile is kept", async () => {
  const { follow } = followed();
  api.readJob.mockResolvedValueOnce(stateOf("running")).mockResolvedValue(stateOf("done"));
  const ended = follow(stateOf("running") as never);
  await vi.runAllTimersAsync();
  await ended;
  expect(errors).toEqual([]);
});

test("an answer to a former request is discarded", async () => {
  const { follow, stop: leave } = polling((error) => errors.push(error));
  let arrive: (found: string) => void = () => undefined;
  let fail: (error: unknown) => void = () => undefined;
  const taken: string[] = [];
  const take = (found: string) => taken.push(found) > 0;
  const first = follow(() => new Promise<string>((resolve) => (arrive = resolve)), take);
  const second = follow(() => new Promise<string>((_, reject) => (fail = reject)), take);
  leave();
  arrive("late");
  fail(unanswered);
  expect(await Promise.all([first, second])).toEqual(["left", "left"]);
  expect([taken, errors]).toEqual([[], []]);
});
