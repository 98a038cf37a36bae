import { useRef } from "preact/hooks";
import { putStiffness } from "../../core/api/client";
import type { Sent, SessionState, StiffnessReference } from "../../core/api/types";
import { shownAs } from "../../core/quantities";
import { standing } from "../../core/state/meanwhile";
import { text } from "../../core/text/en";
import type { SliderRange } from "../../core/widgets/scale";
import { Field } from "./field";
import { ReferenceGroup } from "./reference";

type Sine = Extract<StiffnessReference, { kind: "sine" }>;

/** What the mechanism can reach, N·m/rad. */
const REACH: SliderRange = { min: 1.7, max: 150.56, logarithmic: true };
const KINDS = [
  { value: "constant", label: text.stiffness.constant },
  { value: "sine", label: text.stiffness.sine },
  { value: "other", label: text.references.other },
] as const;

function SineFields({ reference }: { reference: Sine }) {
  const send = (change: Partial<Sine>) =>
    putStiffness({ ...standing("stiffness", reference), ...change });
  return (
    <>
      <Field
        name="stiffness.offset"
        {...shownAs("offset_nm_per_rad")}
        value={reference.offset_nm_per_rad}
        range={REACH}
        send={(value) => send({ offset_nm_per_rad: value })}
      />
      <Field
        name="stiffness.amplitude"
        {...shownAs("amplitude_nm_per_rad")}
        value={reference.amplitude_nm_per_rad}
        range={{ min: 0, max: 30, step: 0.5 }}
        send={(value) => send({ amplitude_nm_per_rad: value })}
      />
      <Field
        name="stiffness.frequency"
        {...shownAs("frequency_hz")}
        value={reference.frequency_hz}
        range={{ min: 0.02, max: 2, logarithmic: true }}
        send={(hz) => send({ frequency_hz: hz })}
      />
    </>
  );
}

/** What to hold, or to swing about, after this reference: its mean, or else its last level. */
function meanOf(reference: StiffnessReference): number {
  const fields: Record<string, unknown> = reference;
  const { offset_nm_per_rad, end_nm_per_rad, stiffness_nm_per_rad } = fields;
  const found = offset_nm_per_rad ?? end_nm_per_rad ?? stiffness_nm_per_rad;
  const last = Array.isArray(found) ? found.at(-1) : found;
  return typeof last === "number" ? last : REACH.min;
}

export function Stiffness({ state }: { state: SessionState }) {
  const reference = state.configuration.stiffness;
  const lastSine = useRef<Sent<Sine> | null>(null);
  if (reference.kind === "sine") lastSine.current = reference;

  const choose = (kind: "sine" | "constant") => {
    const mean = meanOf(reference);
    if (kind === "constant") return putStiffness({ kind, stiffness_nm_per_rad: mean });
    const first = { kind, offset_nm_per_rad: mean, amplitude_nm_per_rad: 1, frequency_hz: 0.2 };
    return putStiffness(lastSine.current ?? first);
  };

  return (
    <ReferenceGroup
      topic="stiffness"
      follows="stiffness"
      reference={reference}
      kinds={KINDS}
      onChoose={choose}
    >
      {reference.kind === "sine" ? (
        <SineFields reference={reference} />
      ) : reference.kind === "constant" ? (
        <Field
          name="stiffness.level"
          {...shownAs("stiffness_nm_per_rad")}
          value={reference.stiffness_nm_per_rad}
          range={REACH}
          send={(value) => putStiffness({ kind: "constant", stiffness_nm_per_rad: value })}
        />
      ) : null}
    </ReferenceGroup>
  );
}
