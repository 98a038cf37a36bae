import type { SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { choosePreset, type Preset } from "../../core/state/presets";
import { text } from "../../core/text/en";
import { Choice } from "../../core/widgets/choice";
import { Problem } from "../../core/widgets/problem";
import { EffectList } from "./effects";
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
