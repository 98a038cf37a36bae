import { useRef } from "preact/hooks";
import { putEffects } from "../api/client";
import type { Effects } from "../api/types";
import { perform } from "../state/actions";
import { EFFECTS, type Effect } from "../state/effects";
import { text } from "../text/en";
import { Field } from "./field";
import { Problem } from "./problem";

const words = text.realism;
type ValueKey = keyof typeof words.values;
interface Value {
  key: ValueKey;
  unit: string;
  /** The value on screen over the value in SI. */
  scale?: number;
}

const VALUES: Record<Effect, readonly Value[]> = {
  encoders: [
    { key: "motor_counts_per_rev", unit: "" },
    { key: "gear_ratio", unit: "" },
    { key: "deflection_counts_per_rev", unit: "" },
  ],
  estimation: [{ key: "corner_rad_per_s", unit: "rad/s" }],
  friction: [
    { key: "coulomb1_nm", unit: "N·m" },
    { key: "coulomb2_nm", unit: "N·m" },
    { key: "static_ratio", unit: "" },
    { key: "stribeck_rad_per_s", unit: "rad/s" },
  ],
  current_lag: [{ key: "time_constant_s", unit: "ms", scale: 1e3 }],
  noise: [
    { key: "motor_std_rad", unit: "mrad", scale: 1e3 },
    { key: "deflection_std_rad", unit: "mrad", scale: 1e3 },
  ],
  gravity: [{ key: "moment_nm", unit: "N·m" }],
};

interface EffectRowProps {
  name: string;
  label: string;
  isOn: boolean;
  onToggle: (isOn: boolean) => unknown;
}

function EffectRow({ name, label, isOn, onToggle }: EffectRowProps) {
  return (
    <>
      <label class="check">
        <input
          type="checkbox"
          checked={isOn}
          onChange={(event) => onToggle(event.currentTarget.checked)}
        />
        {label}
      </label>
      <Problem control={name} />
    </>
  );
}

/** Every effect with its switch, and with its values while it is on. */
export function EffectList({ effects }: { effects: Effects }) {
  const last = useRef<Partial<Effects>>({});
  for (const effect of EFFECTS) {
    if (effects[effect]) last.current = { ...last.current, [effect]: effects[effect] };
  }
  const change = (changes: Partial<Record<keyof Effects, unknown>>) =>
    putEffects({ ...effects, ...changes } as Effects);
  return (
    <div class="effects">
      {EFFECTS.map((effect) => {
        const held = effects[effect] as Record<string, number> | null | undefined;
        const name = `realism.${effect}`;
        return (
          <div key={effect}>
            <EffectRow
              name={name}
              label={words.effects[effect]}
              isOn={Boolean(held)}
              onToggle={(isOn) =>
                perform(name, () =>
                  change({ [effect]: isOn ? (last.current[effect] ?? {}) : null }),
                )
              }
            />
            {held &&
              VALUES[effect].map(({ key, unit, scale = 1 }) => (
                <Field
                  key={key}
                  name={`${name}.${key}`}
                  label={words.values[key]}
                  unit={unit}
                  value={(held[key] as number) * scale}
                  send={(value) => change({ [effect]: { ...held, [key]: value / scale } })}
                />
              ))}
          </div>
        );
      })}
      <div>
        <EffectRow
          name="realism.torque_limits"
          label={words.torqueLimits}
          isOn={effects.torque_limits}
          onToggle={(isOn) =>
            perform("realism.torque_limits", () => change({ torque_limits: isOn }))
          }
        />
      </div>
      <Field
        name="realism.delay"
        label={words.delay}
        unit={words.samples}
        value={effects.delay_samples}
        send={(samples) => change({ delay_samples: samples })}
      />
    </div>
  );
}
