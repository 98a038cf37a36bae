import { useRef } from "preact/hooks";
import { putEffects } from "../../core/api/client";
import type { EffectRow, Effects, SessionState } from "../../core/api/types";
import { LiveFields } from "../../core/forms/fields";
import { LiveNumber } from "../../core/forms/live";
import { changeAt, schemaOfParameter, schemaOfParameters, type Values } from "../../core/schema";
import { perform } from "../../core/state/actions";
import { currentValueOr } from "../../core/state/conflicts";
import { choosePreset, kinds, type Preset } from "../../core/state/kinds";
import { t } from "../../core/text/t";
import { Choice, Problem } from "../../core/widgets/form";
import { Switch } from "../../core/widgets/switch";
import { Group } from "./group";
import { ParameterTable } from "./parameters";

const CHOICES = (["ideal", "rig", "full"] as const satisfies Preset[]).map((value) => ({
  value,
  label: t(`realism.presets.${value}`),
}));

/** Non-ideal effects, and errors of the controller's model. */
export function Realism({ state }: { state: SessionState }) {
  const { effects, effects_preset: preset, actuator, nominal } = state.configuration;
  return (
    <Group
      title={t("realism.title")}
      aside={
        <Choice
          label={t("realism.choose")}
          options={CHOICES}
          value={preset}
          onChoose={(next) => perform("realism.preset", choosePreset(next))}
        />
      }
    >
      <p class="hint">
        {preset === null
          ? t("realism.mixture")
          : kinds.value?.presets.find(({ name }) => name === preset)?.summary}
      </p>
      <Problem control="realism.preset" />
      <details class="more">
        <summary>{t("realism.each")}</summary>
        <EffectList effects={effects} />
      </details>
      <details class="more">
        <summary>{t("realism.parameters")}</summary>
        <ParameterTable actuator={actuator} nominal={nominal} />
      </details>
    </Group>
  );
}

interface EffectControlProps {
  effect: EffectRow;
  effects: Effects;
  /** Its values when it was last on. */
  last: Values | undefined;
}

/** An effect from its description: a switch with its values while it is on, or one value. */
function EffectControl({ effect, effects, last }: EffectControlProps) {
  const name = `realism.${effect.name}`;
  const find = (held: Effects) => (held as Values)[effect.name];
  const send = (value: unknown) =>
    putEffects({ ...currentValueOr("effects", effects), [effect.name]: value } as Effects);
  const toggle = (value: unknown) => perform(name, (edit) => send(value)(edit));
  const held = find(effects);
  if (effect.value?.kind === "number") {
    return (
      <LiveNumber
        name={name}
        schema={schemaOfParameter(effect.value)}
        value={held as number}
        send={send}
      />
    );
  }
  const isOn = Boolean(held);
  const onToggle = (next: boolean) => toggle(effect.value ? next : next ? (last ?? {}) : null);
  return (
    <div>
      <Switch label={effect.meaning} isOn={isOn} onToggle={onToggle} />
      <Problem control={name} />
      {isOn && (
        <LiveFields
          name={name}
          schema={schemaOfParameters(effect.parameters)}
          value={held as Values}
          send={(path, value) =>
            send(changeAt(find(currentValueOr("effects", effects)) ?? held, path, value))
          }
        />
      )}
    </div>
  );
}

/** Every effect that the server describes: those with parameters first. */
function EffectList({ effects }: { effects: Effects }) {
  const last = useRef<Record<string, Values>>({});
  const rows = kinds.value?.effects ?? [];
  for (const { name, value } of rows) {
    const held = (effects as Values)[name];
    if (value === null && held) last.current = { ...last.current, [name]: held as Values };
  }
  const order = (row: EffectRow) => ["flag", "number"].indexOf(row.value?.kind ?? "");
  return (
    <div class="stack tight small effects">
      {[...rows]
        .sort((first, second) => order(first) - order(second))
        .map((effect) => (
          <EffectControl
            key={effect.name}
            effect={effect}
            effects={effects}
            last={last.current[effect.name]}
          />
        ))}
    </div>
  );
}
