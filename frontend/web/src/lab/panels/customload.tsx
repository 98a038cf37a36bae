import { useState } from "preact/hooks";
import { addLoad } from "../../core/api/client";
import type { Load } from "../../core/api/types";
import { quantityOfParameter, quantityProps } from "../../core/quantities";
import { perform } from "../../core/state/actions";
import { isArm, settingsJoint } from "../../core/state/arm";
import { initialValues, kinds, readForm } from "../../core/state/kinds";
import { t } from "../../core/text/t";
import { Choice, Problem } from "../../core/widgets/form";
import { NumberField } from "../../core/widgets/numberinput";
import { EnduranceNote } from "../../hardware/endurance";

type Channel = "0" | "1" | "2";

const CHANNELS = (["0", "1", "2"] as const).map((value) => ({
  value,
  label: t("channels", { returnObjects: true })[Number(value)] as string,
}));

/** A user-defined torque on one of the three channels, of every kind that has a form. */
export function CustomLoad({ isShown }: { isShown: boolean }) {
  const [kind, setKind] = useState("constant");
  const [channel, setChannel] = useState<Channel>("0");
  const [torque, setTorque] = useState(1);
  const [typed, setTyped] = useState<Record<string, number>>({});

  const offered = kinds.value?.loads.filter(({ form }) => form !== null) ?? [];
  const form = offered.find((row) => row.kind === kind)?.form ?? [];
  const values = { ...initialValues(form), ...typed };
  const details = readForm(form, values);
  const torque_nm = CHANNELS.map(({ value }) => (value === channel ? torque : 0));
  const draft = { kind, torque_nm, ...details } as Load;

  const submit = (event: Event) => {
    event.preventDefault();
    void perform("load.custom", addLoad(draft));
  };

  return (
    <form class="stack" onSubmit={submit}>
      <Choice
        label={t("load.customKind")}
        options={offered.map((row) => ({ value: row.kind, label: row.title }))}
        value={kind}
        onChoose={setKind}
      />
      <Choice
        label={t("load.customChannel")}
        options={CHANNELS}
        value={channel}
        onChoose={setChannel}
      />
      <NumberField {...quantityProps("torque_nm")} value={torque} onInput={setTorque} />
      {form.map(({ parameter }) => (
        <NumberField
          key={`${kind}.${parameter.name}`}
          {...quantityOfParameter(parameter)}
          value={values[parameter.name] as number}
          onInput={(value) => setTyped({ ...typed, [parameter.name]: value })}
        />
      ))}
      {isArm.value && (
        <p class="hint">{settingsJoint.value === 1 ? t("arm.torqueOn1") : t("arm.torqueOn2")}</p>
      )}
      <EnduranceNote load={isShown ? draft : null} />
      <button type="submit" class="button">
        {t("load.apply")}
      </button>
      <Problem control="load.custom" />
    </form>
  );
}
