import { useRef } from "preact/hooks";
import { putPosition } from "../../core/api/client";
import type { PositionReference, RequestOf, SessionState } from "../../core/api/types";
import { quantityProps } from "../../core/quantities";
import { currentValueOr } from "../../core/state/conflicts";
import { t } from "../../core/text/t";
import { toRadians } from "../../core/units";
import { Field } from "./field";
import { ReferenceGroup } from "./reference";

type Sine = Extract<PositionReference, { kind: "sine" }>;

const FIRST_SINE: RequestOf<Sine> = {
  kind: "sine",
  amplitude_rad: toRadians(60),
  frequency_hz: 0.2,
};
const KINDS = [
  { value: "sine", label: t("motion.sine") },
  { value: "constant", label: t("motion.constant") },
  { value: "other", label: t("references.other") },
] as const;

function SineFields({ reference }: { reference: Sine }) {
  const send = (change: Partial<Sine>) =>
    putPosition({ ...currentValueOr("position", reference), ...change });
  return (
    <>
      <Field
        name="motion.amplitude"
        {...quantityProps("amplitude_rad")}
        value={reference.amplitude_rad}
        range={{ min: 0, max: 90, step: 1 }}
        send={(amplitude_rad) => send({ amplitude_rad })}
      />
      <Field
        name="motion.frequency"
        {...quantityProps("frequency_hz")}
        value={reference.frequency_hz}
        range={{ min: 0.02, max: 2, logarithmic: true }}
        send={(hz) => send({ frequency_hz: hz })}
      />
      <Field
        name="motion.offset"
        {...quantityProps("offset_rad")}
        value={reference.offset_rad}
        range={{ min: -60, max: 60, step: 1 }}
        send={(offset_rad) => send({ offset_rad })}
      />
    </>
  );
}

export function Motion({ state }: { state: SessionState }) {
  const reference = state.configuration.position;
  const lastSine = useRef<RequestOf<Sine>>(FIRST_SINE);
  if (reference.kind === "sine") lastSine.current = reference;

  const choose = (kind: "sine" | "constant") => {
    if (kind === "sine") return putPosition(lastSine.current);
    const held = reference.kind === "sine" ? reference.offset_rad : 0;
    return putPosition({ kind, position_rad: held });
  };

  return (
    <ReferenceGroup
      topic="motion"
      follows="position"
      reference={reference}
      kinds={KINDS}
      onChoose={choose}
    >
      {reference.kind === "sine" ? (
        <SineFields reference={reference} />
      ) : reference.kind === "constant" ? (
        <Field
          name="motion.position"
          {...quantityProps("position_rad")}
          value={reference.position_rad}
          range={{ min: -90, max: 90, step: 1 }}
          send={(position_rad) => putPosition({ kind: "constant", position_rad })}
        />
      ) : null}
    </ReferenceGroup>
  );
}
