import "../../browserless";
import { beforeAll, beforeEach, describe, expect, it, vi } from "vitest";
import type { Exercise, Step } from "../../../src/core/api/course";
import type { SessionState } from "../../../src/core/api/types";

const calls = {
  pause: vi.fn(),
  reset: vi.fn(),
  start: vi.fn(),
  stopRecording: vi.fn(),
  setUpStep: vi.fn(),
  recordStep: vi.fn(),
  checkRun: vi.fn(),
  readExercise: vi.fn(),
  putAnswer: vi.fn(),
  putLaw: vi.fn(),
  putPlace: vi.fn(),
  readRun: vi.fn(),
};

const step = (name: string, change: object = {}) =>
  ({
    name,
    kind: "experiment",
    duration_s: 6,
    free: [],
    results: [],
    ...change,
  }) as unknown as Step;
const result = (of: string, title: string) => ({ step: of, title }) as never;
const course = (change: object = {}) =>
  ({
    name: "mechanism",
    at: null,
    changes: 0,
    parts: [step("idea", { kind: "read" }), step("lever"), step("bend")],
    ...change,
  }) as unknown as Exercise;
const state = (change: object = {}) =>
  ({
    status: "running",
    tick: 0,
    time_s: 0,
    run_number: 7,
    recording: null,
    bench: null,
    ...change,
  }) as SessionState;
/** Answer of a call; the present state of the session comes from another source and is newer. */
const OLDER = state({ tick: -1 });
const recording = { state: "recording", run_id: "run-1", name: "mechanism/lever" };

let lesson: typeof import("../../../src/teaching/course/lesson");
let runs: typeof import("../../../src/teaching/course/steprun");
let place: typeof import("../../../src/runs/list/place").place;
let session: typeof import("../../../src/core/state/session").session;
let RefusedError: typeof import("../../../src/core/api/errors").RefusedError;

beforeAll(async () => {
  const only = (...names: (keyof typeof calls)[]) =>
    Object.fromEntries(names.map((name) => [name, calls[name]]));
  vi.doMock("../../../src/core/api/client", async (load) => ({
    ...(await load<object>()),
    ...only("pause", "reset", "start", "stopRecording"),
  }));
  vi.doMock("../../../src/core/api/course", async (load) => ({
    ...(await load<object>()),
    ...only(
      "setUpStep",
      "recordStep",
      "checkRun",
      "readExercise",
      "putAnswer",
      "putLaw",
      "putPlace",
    ),
  }));
  vi.doMock("../../../src/core/api/runs", async (load) => ({
    ...(await load<object>()),
    ...only("readRun"),
  }));
  lesson = await import("../../../src/teaching/course/lesson");
  runs = await import("../../../src/teaching/course/steprun");
  ({ place } = await import("../../../src/runs/list/place"));
  ({ session } = await import("../../../src/core/state/session"));
  ({ RefusedError } = await import("../../../src/core/api/errors"));
});

beforeEach(() => {
  for (const call of Object.values(calls)) call.mockReset().mockResolvedValue(OLDER);
  calls.readExercise.mockResolvedValue(course());
  place.value = { kind: "learn", exercise: "mechanism", step: "" };
  session.value = state();
  lesson.exercise.value = course();
  runs.stepRun.value = runs.NO_RUN;
  lesson.problem.value = "";
});

describe("the current step", () => {
  it("is that of the address, by name or number, or the last visited one, or the first", () => {
    const at = (said: string) => {
      place.value = { kind: "learn", exercise: "mechanism", step: said };
      return lesson.step.value?.name;
    };
    expect(at("bend")).toBe("bend");
    expect(at("2")).toBe("lever");
    expect(at("9")).toBe("idea");
    expect(at("no such step")).toBe("idea");
    expect(at("")).toBe("idea");
    lesson.exercise.value = course({ at: "bend" });
    expect(at("")).toBe("bend");
    expect(at("lever")).toBe("lever");
  });

  it("has free settings only if it declares them", () => {
    const free = step("bend", { free: ["stiffness"] });
    lesson.exercise.value = course({ parts: [step("idea", { kind: "read" }), free] });
    expect(lesson.hasFreeSettings.value).toBe(false);
    place.value = { kind: "learn", exercise: "mechanism", step: "bend" };
    expect(lesson.hasFreeSettings.value).toBe(true);
  });

  it("is none for another exercise, or if none is open", () => {
    place.value = { kind: "learn", exercise: "observer", step: "" };
    expect(lesson.step.value).toBeNull();
    place.value = { kind: "lab" };
    expect(lesson.step.value).toBeNull();
  });
});

describe("the run of a step", () => {
  const record = () =>
    calls.recordStep.mockImplementation(async () => {
      session.value = state({ recording });
      return OLDER;
    });

  it("is interrupted without an assessment if control is lost, and can be repeated", async () => {
    record();
    await runs.run(step("lever"));
    const other = { holder: "Bob", mine: false, watching: 1 };
    session.value = state({ recording, time_s: 4.2, control: other });
    await runs.follow();
    expect(runs.stepRun.value.interruption).toEqual({ step: "lever", why: "control", timeS: 4.2 });
    expect(runs.stepRun.value.active).toBeNull();
    expect(calls.stopRecording).not.toHaveBeenCalled();
    expect(calls.checkRun).not.toHaveBeenCalled();
    runs.resume(step("lever"));
    expect(runs.stepRun.value.active, "another's run of the same step").toBeNull();
    session.value = state();
    record();
    await runs.run(step("lever"));
    expect(runs.stepRun.value.interruption).toBeNull();
    expect(runs.stepRun.value.active?.step).toBe("lever");
  });

  it("does not count if its start is rejected, and its recording ends", async () => {
    record();
    calls.start.mockRejectedValue(new RefusedError(409, "The bench is off."));
    await runs.run(step("lever"));
    expect(runs.stepRun.value.active).toBeNull();
    expect(calls.stopRecording).toHaveBeenCalledOnce();
  });

  it("is set up, recorded under the name of the step and started if there are no free settings", async () => {
    record();
    await runs.setUp(step("lever"));
    expect(calls.setUpStep).toHaveBeenCalledWith("mechanism", "lever");
    expect(calls.recordStep).toHaveBeenCalledWith("mechanism/lever");
    expect(calls.start).toHaveBeenCalledOnce();
    expect(runs.stepRun.value.active).toMatchObject({ step: "lever", run: "run-1", endS: 6 });
    expect(runs.isRunOfLesson("run-1")).toBe(true);
    expect(runs.isRunOfLesson("run-2")).toBe(false);
  });

  it("waits for the choice of a free setting", async () => {
    await runs.setUp(step("lever", { free: ["law"] }));
    expect(calls.setUpStep).toHaveBeenCalledOnce();
    expect(calls.recordStep).not.toHaveBeenCalled();
  });

  it("does not start if its recording is rejected", async () => {
    calls.recordStep.mockRejectedValue(new RefusedError(409, "The disk is full."));
    await runs.run(step("lever"));
    expect(calls.start).not.toHaveBeenCalled();
    expect(runs.stepRun.value.active).toBeNull();
  });

  it("runs to the end of the step, and is then stopped and assessed once", async () => {
    record();
    await runs.run(step("lever"));
    session.value = state({ time_s: 5.9, recording });
    await runs.follow();
    expect(calls.stopRecording).not.toHaveBeenCalled();

    calls.readRun.mockResolvedValue({ state: "complete" });
    calls.checkRun.mockResolvedValue([result("lever", "four times as stiff")]);
    session.value = state({ time_s: 6, recording });
    await Promise.all([runs.follow(), runs.follow()]);
    expect(calls.stopRecording).toHaveBeenCalledOnce();
    expect(calls.pause).toHaveBeenCalledTimes(2);
    expect(calls.checkRun).toHaveBeenCalledExactlyOnceWith("mechanism", "lever", "run-1");
    expect(runs.stepRun.value.assessment?.run).toBe("run-1");
    expect(runs.stepRun.value.active).toBeNull();
  });

  it("is assessed up to its end if it ends in a fault or another user stops it", async () => {
    calls.readRun.mockResolvedValue({ state: "complete" });
    for (const ended of [{ status: "fault", recording }, { recording: null }]) {
      session.value = state({ recording });
      runs.resume(step("lever"));
      expect(runs.stepRun.value.active?.run).toBe("run-1");
      calls.checkRun.mockClear();
      session.value = state({ time_s: 2, ...ended });
      await runs.follow();
      expect(calls.checkRun).toHaveBeenCalledOnce();
    }
    expect(calls.stopRecording).toHaveBeenCalledOnce();
  });

  it("is followed again after a reload, and only by its own step", () => {
    session.value = state({ recording });
    runs.resume(step("bend"));
    expect(runs.stepRun.value.active).toBeNull();
    runs.resume(step("lever"));
    expect(runs.stepRun.value.active).toMatchObject({ exercise: "mechanism", step: "lever" });
  });

  it("continues after a state from before its recording that comes late", async () => {
    vi.useFakeTimers();
    record();
    await runs.run(step("lever"));
    calls.readRun.mockResolvedValue({ state: "recording" });
    session.value = state();
    const checked = runs.follow();
    session.value = state({ time_s: 2, recording });
    await vi.advanceTimersByTimeAsync(20_000);
    await checked;
    vi.useRealTimers();
    expect(calls.checkRun).not.toHaveBeenCalled();
    calls.readRun.mockResolvedValue({ state: "complete" });
    session.value = state({ time_s: 6, recording });
    await runs.follow();
    expect(calls.checkRun).toHaveBeenCalledOnce();
    expect(calls.stopRecording).toHaveBeenCalledOnce();
  });

  it("is assessed only after its record is complete", async () => {
    vi.useFakeTimers();
    session.value = state({ time_s: 6, recording });
    runs.resume(step("lever"));
    calls.readRun
      .mockRejectedValueOnce(new TypeError("no answer"))
      .mockResolvedValueOnce({ state: "recording" })
      .mockResolvedValue({ state: "complete" });
    calls.checkRun.mockResolvedValue([]);
    const ended = runs.follow();
    await vi.advanceTimersByTimeAsync(299);
    expect(calls.checkRun).not.toHaveBeenCalled();
    await vi.advanceTimersByTimeAsync(400);
    await ended;
    vi.useRealTimers();
    expect(calls.readRun).toHaveBeenCalledTimes(3);
    expect(calls.checkRun).toHaveBeenCalledOnce();
  });
});

describe("the displayed result of a step", () => {
  it("is the newest assessment of its run, or else the stored one", () => {
    const lever = step("lever", { results: [result("lever", "kept")] });
    const bend = step("bend", { results: [result("bend", "kept")] });
    expect(runs.resultsOf(lever)).toEqual(lever.results);
    const newest = [result("lever", "new"), result("predict-lever", "new")];
    const assessment = { step: "lever", run: "run-2", results: newest };
    runs.stepRun.value = { ...runs.NO_RUN, assessment };
    expect(runs.resultsOf(lever)).toEqual([newest[0]]);
    expect(runs.resultsOf(bend)).toEqual(bend.results);
  });

  it("reports why an answer was rejected, until the next answer", async () => {
    calls.putAnswer.mockRejectedValueOnce(new RefusedError(422, "5 is above 1."));
    await lesson.answer(step("predict-lever"), 5);
    expect(lesson.problem.value).toContain("5 is above 1.");
    expect(lesson.isBusy.value).toBe("");
    calls.putAnswer.mockResolvedValue(course({ at: "lever" }));
    await lesson.answer(step("predict-lever"), 0.7);
    expect(lesson.problem.value).toBe("");
    expect(lesson.exercise.value?.at).toBe("lever");
  });

  it("is that with the most changes if an answer overtakes another", async () => {
    let arrive: (found: Exercise) => void = () => undefined;
    calls.putPlace.mockReturnValue(
      new Promise((resolve) => {
        arrive = resolve;
      }),
    );
    const visited = lesson.storePlace("mechanism", "predict-lost");
    const answered = course({ changes: 2, at: "answered" });
    calls.putAnswer.mockResolvedValue(answered);
    await lesson.answer(step("predict-lost"), 0.544);
    arrive(course({ changes: 1 }));
    await visited;
    expect(lesson.exercise.value).toBe(answered);
  });

  it("is not that of an exercise that was closed before it was read", async () => {
    place.value = { kind: "learn", exercise: "observer", step: "" };
    const observer = course({ name: "observer" });
    lesson.exercise.value = observer;
    await lesson.openExercise("observer");
    expect(lesson.exercise.value).toBe(observer);
  });

  it("stores no place for an observer, and reports no problem", async () => {
    calls.putPlace.mockRejectedValue(new RefusedError(403, "An observer changes nothing."));
    await lesson.storePlace("mechanism", "lever");
    expect(lesson.problem.value).toBe("");
  });
});
