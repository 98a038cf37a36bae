import { useRef } from "preact/hooks";
import { putEffects } from "../../core/api/client";
import type { Effects, SessionState } from "../../core/api/types";
import { shownAs } from "../../core/quantities";
import { perform } from "../../core/state/actions";
import { standing } from "../../core/state/meanwhile";
import { EFFECTS, type Effect } from "../../core/state/plant";
import { choosePreset, type Preset } from "../../core/state/presets";
import { text } from "../../core/text/en";
import { Choice, Problem } from "../../core/widgets/form";
import { Field } from "./field";
import { Group } from "./group";
import { ParameterTable } from "./parameters";

const words = text.realism;
const CHOICES = (Object.keys(words.presets) as Preset[]).map((value) => ({
  value,
  label: words.presets[value],
}));

/** What separates the simulation from a bench: effects, and errors of the controller's model. */
export function Realism({ state }: { state: SessionState }) {
  const { effects, effects_preset: preset, actuator, nominal } = state.configuration;
  return (
    <Group
      title={words.title}
      aside={
        <Choice
          label={words.choose}
          options={CHOICES}
          value={preset}
          onChoose={(next) => perform("realism.preset", () => choosePreset(next))}
        />
      }
    >
      <p class="hint">{preset === null ? words.mixture : words.does[preset]}</p>
      <Problem control="realism.preset" />
      <details class="more">
        <summary>{words.each}</summary>
        <EffectList effects={effects} />
      </details>
      <details class="more">
        <summary>{words.parameters}</summary>
        <ParameterTable actuator={actuator} nominal={nominal} />
      </details>
    </Group>
  );
}

type ValueKey = keyof typeof words.values;

const VALUES: Record<Effect, readonly ValueKey[]> = {
  encoders: ["motor_counts_per_rev", "gear_ratio", "deflection_counts_per_rev"],
  estimation: ["corner_rad_per_s"],
  friction: ["coulomb1_nm", "coulomb2_nm", "static_ratio", "stribeck_rad_per_s"],
  current_lag: ["time_constant_s"],
  noise: ["motor_std_rad", "deflection_std_rad"],
  gravity: ["moment_nm"],
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
function EffectList({ effects }: { effects: Effects }) {
  const last = useRef<Partial<Effects>>({});
  for (const effect of EFFECTS) {
    if (effects[effect]) last.current = { ...last.current, [effect]: effects[effect] };
  }
  const change = (changes: Partial<Record<keyof Effects, unknown>>) =>
    putEffects({ ...standing("effects", effects), ...changes } as Effects);
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
              VALUES[effect].map((key) => (
                <Field
                  key={key}
                  name={`${name}.${key}`}
                  {...shownAs(key)}
                  value={held[key] as number}
                  send={(value) =>
                    change({
                      [effect]: { ...(standing("effects", effects)[effect] ?? held), [key]: value },
                    })
                  }
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
        {...shownAs("delay_samples")}
        value={effects.delay_samples}
        send={(samples) => change({ delay_samples: samples })}
      />
    </div>
  );
}
