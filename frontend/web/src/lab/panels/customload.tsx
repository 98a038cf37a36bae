import { useState } from "preact/hooks";
import { addLoad } from "../../core/api/client";
import type { Load } from "../../core/api/types";
import { Field, RequestFields } from "../../core/forms/fields";
import { useKind } from "../../core/forms/request";
import { FIELDS } from "../../core/quantities";
import { schemaOfKind } from "../../core/schema";
import { execute } from "../../core/state/actions";
import { isArm, settingsJoint } from "../../core/state/arm";
import { kinds } from "../../core/state/kinds";
import { t } from "../../core/text/t";
import { Choice } from "../../core/widgets/form";
import { EnduranceNote } from "../../hardware/endurance";

type Channel = "0" | "1" | "2";

const CHANNELS = (["0", "1", "2"] as const).map((value) => ({
  value,
  label: t("channels", { returnObjects: true })[Number(value)] as string,
}));

/** A user-defined torque on one of the three channels, of every kind that has a form. */
export function CustomLoad({ isShown }: { isShown: boolean }) {
  const [channel, setChannel] = useState<Channel>("0");
  const offered = kinds.value?.loads.filter(({ form }) => form !== null) ?? [];
  const form = useKind((kind) => {
    const { properties } = schemaOfKind(kind, offered);
    return { properties: { torque_nm: { default: [1, 0, 0] }, ...properties } };
  }, "constant");
  const load = form.values as Load;
  const torque = (form.body.torque_nm as number[])[Number(channel)];
  const setTorque = (next: unknown, on: Channel) => {
    setChannel(on);
    form.set({ ...form.body, torque_nm: CHANNELS.map(({ value }) => (value === on ? next : 0)) });
  };

  return (
    <form
      class="stack"
      onSubmit={(event) => {
        event.preventDefault();
        void form.attempt(() => execute(addLoad(load)));
      }}
    >
      <Choice
        label={t("load.customKind")}
        options={offered.map((row) => ({ value: row.kind, label: row.title }))}
        value={form.kind}
        onChoose={form.choose}
      />
      <Choice
        label={t("load.customChannel")}
        options={CHANNELS}
        value={channel}
        onChoose={(next) => setTorque(torque, next)}
      />
      <RequestFields
        key={form.kind}
        form={form}
        schema={form.schema}
        replace={{
          torque_nm: (
            <Field
              name="torque_nm"
              path={`torque_nm[${channel}]`}
              schema={FIELDS.torque_nm}
              value={torque}
              onChange={(next) => setTorque(next, channel)}
            />
          ),
        }}
        isRow
      />
      {isArm.value && <p class="hint">{t("arm.torqueOn", { joint: settingsJoint.value })}</p>}
      <EnduranceNote load={isShown ? load : null} />
      <button type="submit" class="button">
        {t("load.apply")}
      </button>
    </form>
  );
}
