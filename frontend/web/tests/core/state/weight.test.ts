import "../../browserless";
import { expect, it } from "vitest";
import type { BenchState, SessionState } from "../../../src/core/api/types";
import {
  activeWeights,
  chosenForm,
  nextWeight,
  nextWeightForm,
  scheduledWeights,
} from "../../../src/core/state/plant";

const real = { emulated: false } as BenchState;
const emulated = { emulated: true } as BenchState;
const stateOf = (bench: BenchState | null) =>
  ({ actuator: { name: "svsa" }, bench, configuration: { arm: null } }) as unknown as SessionState;

it("adds a mass on a bench, whose motors cannot produce the torques of the paper", () => {
  const states = [null, emulated, real].map(stateOf);
  expect(states.map(nextWeightForm)).toEqual(["paper", "mass", "mass"]);
  chosenForm.value = "paper";
  expect(states.map(nextWeightForm)).toEqual(["paper", "paper", "mass"]);
});

it("adds the default load of another actuator, and recognizes it", () => {
  const load = { kind: "constant", start_s: 5, torque_nm: [0.09, 0, 0] };
  const other = { ...load, torque_nm: [1, 0, 0] };
  const rows = [other, load].map((one, id) => ({ id, active: true, load: one }));
  const configuration = { arm: null };
  const state = { actuator: { name: "qbmove", load }, bench: null, configuration, loads: rows };
  const known = state as unknown as SessionState;
  expect(nextWeight(known)).toEqual({ kind: "constant", torque_nm: [0.09, 0, 0] });
  expect(activeWeights(known).map(({ id }) => id)).toEqual([1]);
});

it("brings the scheduled load forward, and no other one", () => {
  const paper = { kind: "paper" };
  const rows = [
    { id: 0, active: false, start_s: 5, load: paper },
    { id: 1, active: false, start_s: 1, load: paper },
    { id: 2, active: true, start_s: 1, load: paper },
    { id: 3, active: false, start_s: 5, load: { kind: "sine" } },
  ];
  const known = { ...stateOf(null), time_s: 2, loads: rows } as unknown as SessionState;
  expect(scheduledWeights(known).map(({ id }) => id)).toEqual([0]);
});
