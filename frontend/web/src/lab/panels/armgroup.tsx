/** The joint of settings and plots, and the settings of an arm as a whole. */
import { useId, useRef } from "preact/hooks";
import type { ArmPatch, ArmSetup } from "../../core/api/arm";
import { addLoad, patchArm, removeLoad } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { type Lengths, lengthsOf, placeTip, reachOf } from "../../core/armgeometry";
import { LiveNumber } from "../../core/forms/live";
import { FIELDS } from "../../core/quantities";
import { perform } from "../../core/state/actions";
import { chosenJoint, jointChoice, jointCount } from "../../core/state/arm";
import { armOf, listJoints } from "../../core/state/joints";
import { tipMassKg } from "../../core/state/plant";
import { samples } from "../../core/state/session";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { Choice, Problem } from "../../core/widgets/form";
import { Switch } from "../../core/widgets/switch";
import { Group } from "./group";

const listChoices = (count: number) => [
  { value: "all", label: t("arm.allJoints") },
  ...listJoints(count).map((joint) => ({
    value: String(joint),
    label: t("arm.jointNumber", { joint }),
  })),
];

const MASSES = { min: 0.05, max: 2, logarithmic: true };

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
function rightmostReference(lengths: Lengths): number {
  const { ring } = samples;
  let most = 0;
  for (let index = 0; index < ring.length; index += SAMPLE_STEP) {
    const q = lengths.map((_, joint) => ring.valueAt("position_reference_rad", index, joint + 1));
    most = Math.max(most, placeTip(lengths, q).x || 0);
  }
  return most > 0 ? most : reachOf(lengths);
}

function Wall({ state }: { state: SessionState }) {
  const arm = armOf(state);
  const walls = state.loads.filter(({ active, load }) => active && load.kind === "wall");
  const [wall] = walls;
  const toggle = () =>
    perform("arm.wall", async (edit) => {
      if (wall !== undefined || arm === null) return removeLoad(wall?.id ?? 0)();
      const at = WALL_SHARE * rightmostReference(lengthsOf(arm.links));
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
function buildEllipse(links: ArmSetup["links"]): NonNullable<ArmPatch["tip"]> {
  const reach = reachOf(lengthsOf(links));
  return {
    kind: "ellipse",
    elbow: "positive",
    center_m: [0.42 * reach, -0.58 * reach],
    radii_m: [0.17 * reach, 0.08 * reach],
    frequency_hz: 0.25,
  };
}

/** Inverse kinematics is that of two links: with more, a point of the tip has many poses. */
const LINKS_OF_A_TIP_REFERENCE = 2;
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
  const joint = chosenJoint.value;
  return (
    <Group
      title={t("arm.title")}
      aside={
        <Choice
          label={t("arm.joint")}
          options={listChoices(jointCount.value)}
          value={joint === null ? "all" : String(joint)}
          onChoose={(next) => {
            jointChoice.value = next;
          }}
        />
      }
    >
      {!isBasic && (
        <p class="hint is-about">
          {joint === null ? t("arm.appliesToAll") : t("arm.onlyJoint", { joint })}
        </p>
      )}
      <div class="row">
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
      {!isBasic && arm.links.chain.length === LINKS_OF_A_TIP_REFERENCE && (
        <ReferenceChoice arm={arm} />
      )}
      <LiveNumber
        name="arm.mass"
        schema={{ ...FIELDS.mass_kg, minimum: 0.001, slider: MASSES }}
        value={tipMassKg.value}
        send={(mass) => async () => {
          tipMassKg.value = mass;
          return state;
        }}
      />
    </Group>
  );
}
