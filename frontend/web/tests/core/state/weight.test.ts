import "../../browserless";
import { expect, it } from "vitest";
import type { BenchState } from "../../../src/core/api/types";
import { chosenForm, formOfNext } from "../../../src/core/state/plant";

const real = { emulated: false } as BenchState;
const emulated = { emulated: true } as BenchState;

it("hangs a mass on a bench, whose motors do not hold the paper's torques", () => {
  expect([null, emulated, real].map(formOfNext)).toEqual(["paper", "mass", "mass"]);
  chosenForm.value = "paper";
  expect([null, emulated, real].map(formOfNext)).toEqual(["paper", "paper", "mass"]);
});
