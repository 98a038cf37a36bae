import { describe, expect, it } from "vitest";
import type { Effects } from "../../../src/core/api/types";
import { EFFECTS, PRESETS, type Preset, presetOf } from "../../../src/core/state/plant";

/** What the server makes of a request: what is left out is off. */
const answer = (request: object): Effects =>
  ({
    ...Object.fromEntries(EFFECTS.map((effect) => [effect, null])),
    delay_samples: 0,
    torque_limits: true,
    ...request,
  }) as Effects;

describe("presetOf", () => {
  it.each(Object.keys(PRESETS) as Preset[])("knows %s again, whatever its values", (name) => {
    expect(presetOf(answer(PRESETS[name]))).toBe(name);
  });

  it.each([
    { ...PRESETS.rig, delay_samples: 2 },
    { ...PRESETS.rig, noise: {} },
    { ...PRESETS.full, gravity: null },
    { torque_limits: false },
  ])("calls %j a mixture", (effects) => {
    expect(presetOf(answer(effects))).toBeNull();
  });
});
