import schema from "schema:SpringEstimation";
import { putSpring } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { LiveFields } from "../../core/forms/fields";
import { describeKnowledge } from "../../core/plots/estimate";
import { changeAt, type Schema } from "../../core/schema";
import { perform } from "../../core/state/actions";
import { settingsJoint } from "../../core/state/arm";
import { currentValueOr } from "../../core/state/conflicts";
import { samples } from "../../core/state/session";
import { t } from "../../core/text/t";
import { Problem } from "../../core/widgets/form";
import { useLiveText } from "../../core/widgets/live";
import { Switch } from "../../core/widgets/switch";
import { Group } from "./group";

/** The numbers, under their titles: the switch is above them. */
const NUMBERS: Schema = {
  properties: Object.fromEntries(
    Object.entries((schema as Schema).properties ?? {}).flatMap(
      ([name, { symbol: _, ...field }]) => (field.type === "number" ? [[name, field]] : []),
    ),
  ),
};

/** Of the joint whose settings are shown. */
const readKnowledge = () =>
  describeKnowledge((channel) => samples.ring.newest(channel, settingsJoint.peek()));

function Knowledge() {
  return <p class="small strong" ref={useLiveText<HTMLParagraphElement>(readKnowledge)} />;
}

export function Spring({ state }: { state: SessionState }) {
  const { spring } = state.configuration;
  const send = (path: string, value: unknown) =>
    putSpring(changeAt(currentValueOr("spring", spring), path, value));
  return (
    <Group title={t("spring.title")}>
      <Switch
        label={t("spring.on")}
        hint={t("spring.onHint")}
        isOn={spring.is_on}
        onToggle={(isOn) => perform("spring", send("is_on", isOn))}
      />
      <Problem control="spring" />
      {spring.is_on && <Knowledge />}
      <details class="more">
        <summary>{t("spring.each")}</summary>
        <LiveFields name="spring" schema={NUMBERS} value={spring} send={send} />
      </details>
    </Group>
  );
}
