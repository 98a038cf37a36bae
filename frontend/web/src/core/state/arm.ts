/** The joint of an arm to which settings and plots of the page belong. */
import { computed, signal } from "@preact/signals";
import type { Joint, SessionState } from "../api/types";
import {
  type Armed,
  armOf,
  configurationsOf,
  jointCountOf,
  listJoints,
  settingsOfJoint,
} from "./joints";
import { session } from "./session";

/** "all", or the number of a joint. */
export const jointChoice = signal("all");

/** Number of joints of the session; 1 for a single joint. */
export const jointCount = computed(() =>
  session.value === null ? 1 : jointCountOf(session.value),
);

/** The joint that commands of the page change; null for all, and for a single joint. */
export const chosenJoint = computed<Joint | null>(() =>
  jointChoice.value === "all" ? null : Number(jointChoice.value),
);

/** The joint of the settings on the page: with all joints, those of joint 1 are shown. */
export const settingsJoint = computed<Joint>(() => chosenJoint.value ?? 1);

export const isArm = computed(() => session.value !== null && armOf(session.value) !== null);

/** The session with the settings of the chosen joint. */
export const settingsOf = <T extends Armed>(state: T): T =>
  settingsOfJoint(state, settingsJoint.value);

/** The session with the settings of the chosen joint; null before the first message. */
export const settings = computed(() => session.value && settingsOf(session.value));

/** Whether all joints are chosen and differ in one of these parts of their configuration. */
export function areJointsDifferent(
  state: SessionState,
  parts: readonly (keyof SessionState["configuration"])[],
): boolean {
  if (chosenJoint.value !== null) return false;
  const joints = configurationsOf(state);
  return parts.some((part) => new Set(joints.map((of) => JSON.stringify(of[part]))).size > 1);
}

/** The joints whose plots are shown; null for a single joint. */
export const shownJoints = computed<readonly Joint[] | null>(() => {
  if (!isArm.value) return null;
  return chosenJoint.value === null ? listJoints(jointCount.value) : [chosenJoint.value];
});
