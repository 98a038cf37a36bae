import { putEffects } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { PRESETS, type Preset, presetOf } from "../../core/state/plant";
import { text } from "../../core/text/en";
import { Choice } from "../../core/widgets/choice";
import { Problem } from "../../core/widgets/problem";
import { EffectList } from "./effects";
import { Group } from "./group";
import { ParameterTable } from "./parameters";

const words = text.realism;
const CHOICES = (Object.keys(PRESETS) as Preset[]).map((value) => ({
  value,
  label: words.presets[value],
}));

/** What separates the simulation from a bench: effects, and errors of the controller's model. */
export function Realism({ state }: { state: SessionState }) {
  const { effects, actuator, nominal } = state.configuration;
  const preset = presetOf(effects);
  return (
    <Group
      title={words.title}
      aside={
        <Choice
          label={words.choose}
          options={CHOICES}
          value={preset}
          onChoose={(next) => perform("realism.preset", () => putEffects(PRESETS[next]))}
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
