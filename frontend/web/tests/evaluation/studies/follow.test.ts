import "../../browserless";
import { expect, test, vi } from "vitest";

const api = {
  readStudy: vi.fn(),
  readSummary: vi.fn(),
  readSensitivity: vi.fn(),
  readRows: vi.fn(),
  listStudies: vi.fn(),
};
vi.doMock("../../../src/core/api/studies", async (load) => ({ ...(await load<object>()), ...api }));
const { follow, indices, leave, problem } = await import("../../../src/evaluation/studies/studies");
const { place } = await import("../../../src/runs/list/place");

const ended = (name: string) => ({
  name,
  study: { sampling: "sensitivity" },
  job: { state: "done" },
  laws: ["fl"],
  columns: [],
  done: 8,
});
const look = (study: string) => {
  place.value = { kind: "studies", study, look: {} };
  return follow(study);
};

test("shares that arrive after their study was closed are not shown for another study", async () => {
  let arrive: (shares: object[]) => void = () => undefined;
  for (const call of Object.values(api)) call.mockRejectedValue(new Error("not asked for here"));
  api.readStudy.mockImplementation(async (name: string) => ended(name));
  api.readSensitivity.mockImplementationOnce(
    () =>
      new Promise((resolve) => {
        arrive = resolve;
      }),
  );
  const first = look("first");
  await vi.waitFor(() => expect(api.readSensitivity).toHaveBeenCalledOnce());
  api.readSensitivity.mockResolvedValue([{ parameter: "of the second" }]);
  await look("second");
  arrive([{ parameter: "of the first" }]);
  await first;
  expect(indices.value).toEqual([{ parameter: "of the second" }]);
});

test("a message of the form stays when the list arrives, and disappears with its study", async () => {
  api.readStudy.mockImplementation(async (name: string) => ({ ...ended(name), done: 0 }));
  api.listStudies.mockResolvedValue({ saved: [] });
  problem.value = "line 2: runs is 0";
  leave("");
  await look("first");
  expect(problem.value).toBe("line 2: runs is 0");
  leave("first");
  expect(problem.value).toBe("");
});
