import "../../browserless";
import { beforeAll, beforeEach, expect, it, vi } from "vitest";
import type { RunPatch, RunSummary } from "../../../src/core/api/types";

const run = {
  id: "run-1",
  revision: "1",
  name: "",
  notes: "",
  tags: [""],
} as unknown as RunSummary;
const listRuns = vi.fn().mockResolvedValue({ runs: [], total: 0 });
const changeRun = vi.fn<(base: RunSummary, patch: RunPatch) => Promise<RunSummary>>();
let patchRun: typeof import("../../../src/runs/list/list").patchRun;
let RefusedError: typeof import("../../../src/core/api/errors").RefusedError;
let runsProblem: typeof import("../../../src/runs/list/problem").runsProblem;

beforeAll(async () => {
  vi.doMock("../../../src/core/api/runs", async (load) => ({
    ...(await load<object>()),
    changeRun,
    listRuns,
  }));
  ({ patchRun } = await import("../../../src/runs/list/list"));
  ({ RefusedError } = await import("../../../src/core/api/errors"));
  ({ runsProblem } = await import("../../../src/runs/list/problem"));
});

beforeEach(() => {
  listRuns.mockClear();
  changeRun.mockReset().mockImplementation(async (base, patch) => ({
    ...base,
    ...(patch as Partial<RunSummary>),
    revision: `${Number(base.revision) + 1}`,
  }));
});

const listRevisions = () => changeRun.mock.calls.map(([base]) => base.revision);

it("waits for the answer to the previous change, and changes its revision", async () => {
  await Promise.all([patchRun(run, { name: "A" }), patchRun(run, { notes: "steady" })]);
  expect(listRevisions()).toEqual(["1", "2"]);
});

it("overwrites no change of the same field that it did not know", async () => {
  await Promise.all([patchRun(run, { tags: ["a"] }), patchRun(run, { tags: ["b"] })]);
  expect(listRevisions()).toEqual(["1", "1"]);
});

it("is of the displayed revision for another run, after a rejection, and later", async () => {
  changeRun.mockRejectedValueOnce(new Error("rejected"));
  const other = { ...run, id: "run-2", revision: "7" };
  await Promise.all([
    patchRun(run, { name: "A" }),
    patchRun(run, { notes: "steady" }),
    patchRun(other, { name: "B" }),
  ]);
  await patchRun({ ...run, revision: "5" }, { notes: "again" });
  expect(listRevisions()).toEqual(["1", "1", "7", "5"]);
});

it("shows why it was rejected, also after the list was read again", async () => {
  changeRun.mockRejectedValueOnce(new RefusedError(412, "The run was changed."));
  expect(await patchRun(run, { notes: "steady" })).toBeNull();
  await vi.waitFor(() => expect(listRuns).toHaveBeenCalled());
  expect(runsProblem.value).toBe("The run was changed.");
});
