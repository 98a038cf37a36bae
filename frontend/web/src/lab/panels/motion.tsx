import { useRef } from "preact/hooks";
import { putPosition } from "../../core/api/client";
import type { PositionReference, RequestOf, SessionState } from "../../core/api/types";
import { FIELDS } from "../../core/quantities";
import { t } from "../../core/text/t";
import { toRadians } from "../../core/units";
import { FREQUENCIES, ReferenceGroup } from "./reference";

type Sine = Extract<PositionReference, { kind: "sine" }>;

const FIRST_SINE = { kind: "sine", amplitude_rad: toRadians(60), frequency_hz: 0.2 } as const;
const KINDS = [
  { value: "sine", label: t("motion.sine") },
  { value: "constant", label: t("motion.constant") },
  { value: "other", label: t("references.other") },
] as const;

const SCHEMAS = {
  sine: {
    properties: {
      amplitude_rad: { ...FIELDS.amplitude_rad, slider: { min: 0, max: 90, step: 1 } },
      frequency_hz: { ...FIELDS.frequency_hz, slider: FREQUENCIES },
      offset_rad: { ...FIELDS.offset_rad, slider: { min: -60, max: 60, step: 1 } },
    },
  },
  constant: {
    properties: {
      position_rad: { ...FIELDS.position_rad, slider: { min: -90, max: 90, step: 1 } },
    },
  },
};

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
      schemas={SCHEMAS}
    />
  );
}
