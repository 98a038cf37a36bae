/** The joint of an arm to which settings and plots of the page belong. */
import { computed, signal } from "@preact/signals";
import type { Joint, SessionState } from "../api/types";
import { type Armed, armOf, settingsOfJoint } from "./joints";
import { session } from "./session";

export type JointChoice = "both" | "1" | "2";

export const jointChoice = signal<JointChoice>("both");

/** The joint of the settings on the page: with both joints, those of joint 1 are shown. */
export const settingsJoint = computed<Joint>(() => (jointChoice.value === "2" ? 2 : 1));

/** The joint that commands of the page change; null for both, and for a single joint. */
export const chosenJoint = computed<Joint | null>(() =>
  jointChoice.value === "both" ? null : (Number(jointChoice.value) as Joint),
);

export const isArm = computed(() => session.value !== null && armOf(session.value) !== null);

/** The session with the settings of the chosen joint. */
export const settingsOf = <T extends Armed>(state: T): T =>
  settingsOfJoint(state, settingsJoint.value);

/** The session with the settings of the chosen joint; null before the first message. */
export const settings = computed(() => session.value && settingsOf(session.value));

/** Whether both joints are chosen and differ in one of these parts of their configuration. */
export function areJointsDifferent(
  state: SessionState,
  parts: readonly (keyof SessionState["configuration"])[],
): boolean {
  const arm = armOf(state);
  if (arm === null || jointChoice.value !== "both") return false;
  return parts.some(
    (part) => JSON.stringify(state.configuration[part]) !== JSON.stringify(arm.joint2[part]),
  );
}

/** The joints whose plots are shown; null for a single joint. */
export const shownJoints = computed<readonly Joint[] | null>(() => {
  if (!isArm.value) return null;
  return chosenJoint.value === null ? [1, 2] : [chosenJoint.value];
});
