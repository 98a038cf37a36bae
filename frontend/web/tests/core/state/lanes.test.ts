import { expect, it, vi } from "vitest";
import { SampleRing } from "../../../src/core/stream/ring";

const FOREVER = { start_s: 0, end_s: null };
const laneOf = (id: number, name: string) => ({ id, segments: [{ ...FOREVER, name }] });
const stateAt = (tick: number, lanes: object[]) =>
  ({ run_number: 1, tick, lanes, configuration: {} }) as never;
const batchAt = (tick: number, lanes: number[], values: number[]) => ({
  ...{ run: 1, firstTick: tick, stride: 1, count: 1, missed: 0 },
  ...{ lanes, values: new Float32Array(values) },
});

it("the other lanes keep their samples and names if a script removes a lane", async () => {
  vi.stubGlobal("window", new EventTarget());
  vi.stubGlobal("document", { baseURI: "http://lab/" });
  vi.stubGlobal("location", { search: "" });
  const { acceptState, samples, session } = await import("../../../src/core/state/session");
  const { controllerNames } = await import("../../../src/core/state/lanes");
  const [ndobc, fl, faster] = [laneOf(1, "NDOBC"), laneOf(2, "FL"), laneOf(3, "NDOBC β 120")];
  samples.ring = new SampleRing(10, ["a"], [1, 2, 3]);
  session.value = stateAt(0, [ndobc, fl, faster]);
  acceptState(stateAt(0, [ndobc, fl, faster]));
  samples.ring.append(batchAt(0, [1, 2, 3], [1, 20, 300]), 1);

  acceptState(stateAt(1, [ndobc, faster]));
  samples.ring.append(batchAt(1, [1, 2, 3], [2, 21, 301]), 1);
  samples.ring.append(batchAt(2, [1, 3], [3, 302]), 1);

  const drawn = controllerNames.value.map((name, index) => [
    name,
    ...[0, 1, 2].map((sample) => samples.ring.valueAt("a", sample, index + 1)),
  ]);
  expect(drawn).toEqual([
    ["NDOBC", 1, 2, 3],
    ["NDOBC β 120", 300, 301, 302],
  ]);
});
