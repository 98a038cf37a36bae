/** The joint of settings and plots, and the settings of an arm as a whole. */
import { useId, useRef } from "preact/hooks";
import type { ArmPatch, ArmSetup } from "../../core/api/arm";
import { addLoad, patchArm, removeLoad } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { placeLinks } from "../../core/armgeometry";
import { perform } from "../../core/state/actions";
import { type JointChoice, jointChoice } from "../../core/state/arm";
import { armOf } from "../../core/state/joints";
import { tipMassKg } from "../../core/state/plant";
import { samples } from "../../core/state/session";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { Choice, Problem } from "../../core/widgets/form";
import { Switch } from "../../core/widgets/switch";
import { Field } from "./field";
import { Group } from "./group";

const JOINTS = (["both", "1", "2"] as const satisfies JointChoice[]).map((value) => ({
  value,
  label: t(`arm.joints.${value}`),
}));

/** The estimates of the mass at the tip, of both arms. */
function Estimate({ state }: { state: SessionState }) {
  const { payload_kg: masses } = state;
  if (!masses) return null;
  return (
    <p class="hint tabular arm-estimate">
      {t("arm.estimate")}{" "}
      {masses.map((mass, index) => (
        <span key={index === 0 ? "own" : "other"}>
          <strong class="number">{formatNumber(mass, 3, 3)}</strong>{" "}
          {index === 0 ? t("arm.kilograms") : t("arm.ofComparison")}{" "}
        </span>
      ))}
    </p>
  );
}

const WALL = {
  kind: "wall",
  normal_rad: Math.PI,
  stiffness_n_per_m: 500,
  damping_ns_per_m: 10,
} as const;
/** Distance of the wall from joint 1 relative to the rightmost point of the tip's reference. */
const WALL_SHARE = 0.8;
const SAMPLE_STEP = 10;

/** Rightmost point of the tip's reference in the stored samples, m. */
function rightmostReference({ length1_m, length2_m }: ArmSetup["links"]): number {
  const { ring } = samples;
  let most = 0;
  for (let index = 0; index < ring.length; index += SAMPLE_STEP) {
    const read = (lane: number) => ring.valueAt("position_reference_rad", index, lane);
    const { tip } = placeLinks({ length1: length1_m, length2: length2_m }, read(1), read(2));
    if (tip.x > most) most = tip.x;
  }
  return most > 0 ? most : length1_m + length2_m;
}

function Wall({ state }: { state: SessionState }) {
  const arm = armOf(state);
  const walls = state.loads.filter(({ active, load }) => active && load.kind === "wall");
  const [wall] = walls;
  const toggle = () =>
    perform("arm.wall", async (edit) => {
      if (wall !== undefined || arm === null) return removeLoad(wall?.id ?? 0)();
      const at = WALL_SHARE * rightmostReference(arm.links);
      return addLoad({ ...WALL, distance_m: -at })(edit);
    });
  return (
    <>
      <Switch
        label={t("arm.wall")}
        hint={t("arm.wallHint")}
        isOn={wall !== undefined}
        onToggle={toggle}
      />
      <Problem control="arm.wall" />
    </>
  );
}

/** An ellipse in front of the arm, whose points it reaches with a bent elbow. */
function buildEllipse({ length1_m, length2_m }: ArmSetup["links"]): NonNullable<ArmPatch["tip"]> {
  const reach = length1_m + length2_m;
  return {
    kind: "ellipse",
    elbow: "positive",
    center_m: [0.42 * reach, -0.58 * reach],
    radii_m: [0.17 * reach, 0.08 * reach],
    frequency_hz: 0.25,
  };
}

const REFERENCES = (["joints", "tip"] as const).map((value) => ({
  value,
  label: t(`arm.references.${value}`),
}));

/** What follows a reference of its own: each joint, or the tip. */
function ReferenceChoice({ arm }: { arm: ArmSetup }) {
  const id = useId();
  const choose = (value: "joints" | "tip") =>
    perform("arm.reference", patchArm({ tip: value === "tip" ? buildEllipse(arm.links) : null }));
  return (
    <>
      <div class="spread">
        <span>{t("arm.reference")}</span>
        <Choice
          label={t("arm.reference")}
          options={REFERENCES}
          value={arm.tip === null ? "joints" : "tip"}
          describedBy={id}
          onChoose={choose}
        />
      </div>
      <p class="hint" id={id}>
        {t("arm.referenceHint")}
      </p>
      <Problem control="arm.reference" />
    </>
  );
}

export function ArmGroup({ state, isBasic }: { state: SessionState; isBasic: boolean }) {
  const arm = armOf(state);
  const last = useRef<NonNullable<ArmPatch["adaptation"]> | null>(null);
  if (arm === null) return null;
  if (arm.adaptation) last.current = arm.adaptation;
  const send = (patch: ArmPatch) => perform("arm", patchArm(patch));
  const choice = jointChoice.value;
  return (
    <Group
      title={t("arm.title")}
      aside={
        <Choice
          label={t("arm.joint")}
          options={JOINTS}
          value={choice}
          onChoose={(next) => {
            jointChoice.value = next;
          }}
        />
      }
    >
      {!isBasic && (
        <p class="hint is-about">
          {choice === "both" ? t("arm.both") : t("arm.onlyJoint", { joint: choice })}
        </p>
      )}
      <div class="row joined">
        <Switch
          label={t("arm.feedforward")}
          hint={t("arm.feedforwardHint")}
          isOn={arm.feedforward}
          onToggle={() => send({ feedforward: !arm.feedforward })}
        />
        <Switch
          label={t("arm.adaptation")}
          hint={t("arm.adaptationHint")}
          isOn={arm.adaptation !== null}
          onToggle={() =>
            send({ adaptation: arm.adaptation === null ? (last.current ?? {}) : null } as ArmPatch)
          }
        />
        <Wall state={state} />
      </div>
      <Problem control="arm" />
      <Estimate state={state} />
      {!isBasic && <ReferenceChoice arm={arm} />}
      <Field
        name="arm.mass"
        label={t("arm.mass")}
        unit="kg"
        min={0.001}
        max={20}
        value={tipMassKg.value}
        range={{ min: 0.05, max: 2, logarithmic: true }}
        send={(mass) => async () => {
          tipMassKg.value = mass;
          return state;
        }}
      />
    </Group>
  );
}
