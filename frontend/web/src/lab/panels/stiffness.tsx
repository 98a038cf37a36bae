import { useRef } from "preact/hooks";
import { putStiffness } from "../../core/api/client";
import type { RequestOf, SessionState, StiffnessReference } from "../../core/api/types";
import { FIELDS } from "../../core/quantities";
import type { SliderRange } from "../../core/scale";
import { t } from "../../core/text/t";
import { formatInput } from "../../core/units";
import { Group } from "./group";
import { FREQUENCIES, ReferenceGroup } from "./reference";

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

/** Levels in the range of the actuator. */
function schemasOf(reach: SliderRange) {
  const { min: minimum, max: maximum } = reach;
  const level = { minimum, maximum, slider: reach };
  return {
    sine: {
      properties: {
        offset_nm_per_rad: { ...FIELDS.offset_nm_per_rad, ...level },
        amplitude_nm_per_rad: { ...FIELDS.amplitude_nm_per_rad, slider: amplitudesOf(reach) },
        frequency_hz: { ...FIELDS.frequency_hz, slider: FREQUENCIES },
      },
    },
    constant: {
      properties: { stiffness_nm_per_rad: { ...FIELDS.stiffness_nm_per_rad, ...level } },
    },
  };
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
      schemas={schemasOf(reach)}
    />
  );
}
