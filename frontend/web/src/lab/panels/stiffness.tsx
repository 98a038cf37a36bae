import { useRef } from "preact/hooks";
import { putStiffness } from "../../core/api/client";
import type { RequestOf, SessionState, StiffnessReference } from "../../core/api/types";
import { quantityProps } from "../../core/quantities";
import { currentValueOr } from "../../core/state/conflicts";
import { t } from "../../core/text/t";
import { formatInput } from "../../core/units";
import type { SliderRange } from "../../core/widgets/scale";
import { Field } from "./field";
import { Group } from "./group";
import { ReferenceGroup } from "./reference";

type Sine = Extract<StiffnessReference, { kind: "sine" }>;

const AMPLITUDE_SHARE = 0.2;
const AMPLITUDE_STEPS = 60;

/** The stiffness range of the session's actuator, N·m/rad. */
const reachOf = ({ configuration: { limits } }: SessionState): SliderRange => ({
  min: limits.stiffness_min_nm_per_rad,
  max: limits.stiffness_max_nm_per_rad,
  logarithmic: true,
});

/** Amplitudes up to a fifth of the range, with two digits. */
function amplitudesOf({ min, max }: SliderRange): SliderRange {
  const most = Number((AMPLITUDE_SHARE * (max - min)).toPrecision(2));
  return { min: 0, max: most, step: most / AMPLITUDE_STEPS };
}
const KINDS = [
  { value: "constant", label: t("stiffness.constant") },
  { value: "sine", label: t("stiffness.sine") },
  { value: "other", label: t("references.other") },
] as const;

function SineFields({ reference, reach }: { reference: Sine; reach: SliderRange }) {
  const send = (change: Partial<Sine>) =>
    putStiffness({ ...currentValueOr("stiffness", reference), ...change });
  return (
    <>
      <Field
        name="stiffness.offset"
        {...quantityProps("offset_nm_per_rad")}
        min={reach.min}
        max={reach.max}
        value={reference.offset_nm_per_rad}
        range={reach}
        send={(value) => send({ offset_nm_per_rad: value })}
      />
      <Field
        name="stiffness.amplitude"
        {...quantityProps("amplitude_nm_per_rad")}
        value={reference.amplitude_nm_per_rad}
        range={amplitudesOf(reach)}
        send={(value) => send({ amplitude_nm_per_rad: value })}
      />
      <Field
        name="stiffness.frequency"
        {...quantityProps("frequency_hz")}
        value={reference.frequency_hz}
        range={{ min: 0.02, max: 2, logarithmic: true }}
        send={(hz) => send({ frequency_hz: hz })}
      />
    </>
  );
}

/** Level or mean for the next reference: the mean of this one, or its last level. */
function meanOf(reference: StiffnessReference, otherwise: number): number {
  const fields: Record<string, unknown> = reference;
  const { offset_nm_per_rad, end_nm_per_rad, stiffness_nm_per_rad } = fields;
  const level = offset_nm_per_rad ?? end_nm_per_rad ?? stiffness_nm_per_rad;
  const last = Array.isArray(level) ? level.at(-1) : level;
  return typeof last === "number" ? last : otherwise;
}

export function Stiffness({ state }: { state: SessionState }) {
  const reference = state.configuration.stiffness;
  const reach = reachOf(state);
  const lastSine = useRef<RequestOf<Sine> | null>(null);
  if (reference.kind === "sine") lastSine.current = reference;

  const choose = (kind: "sine" | "constant") => {
    const mean = meanOf(reference, reach.min);
    if (kind === "constant") return putStiffness({ kind, stiffness_nm_per_rad: mean });
    const amplitude = Math.min(1, 0.1 * mean);
    const first = {
      kind,
      offset_nm_per_rad: mean,
      amplitude_nm_per_rad: amplitude,
      frequency_hz: 0.2,
    };
    return putStiffness(lastSine.current ?? first);
  };

  const only = state.actuator.only_stiffness_nm_per_rad;
  if (only !== null) {
    return (
      <Group title={t("stiffness.title")} topic="stiffness">
        <p class="hint">
          {t("stiffness.fixed", { actuator: state.actuator.title, sigma: formatInput(only) })}
        </p>
      </Group>
    );
  }
  return (
    <ReferenceGroup
      topic="stiffness"
      follows="stiffness"
      reference={reference}
      kinds={KINDS}
      onChoose={choose}
    >
      {reference.kind === "sine" ? (
        <SineFields reference={reference} reach={reach} />
      ) : reference.kind === "constant" ? (
        <Field
          name="stiffness.level"
          {...quantityProps("stiffness_nm_per_rad")}
          min={reach.min}
          max={reach.max}
          value={reference.stiffness_nm_per_rad}
          range={reach}
          send={(value) => putStiffness({ kind: "constant", stiffness_nm_per_rad: value })}
        />
      ) : null}
    </ReferenceGroup>
  );
}
