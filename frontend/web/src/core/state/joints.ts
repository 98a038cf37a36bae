/** The arm of a session: its joints, their settings and their lanes. */
import type { ArmSetup } from "../api/arm";
import type { Configuration, Joint, SessionState } from "../api/types";

export type Armed = Pick<SessionState, "configuration">;

/** The arm of a session; null for a single joint. */
export const armOf = ({ configuration }: Armed): ArmSetup | null => configuration.arm ?? null;

/** Number of joints: 1 without an arm. A plant has as many lanes: those of its joints in order. */
export const jointCountOf = (state: Armed): number => 1 + (armOf(state)?.other_joints.length ?? 0);

/** 1, 2 … */
export const listJoints = (count: number): Joint[] =>
  Array.from({ length: count }, (_, index) => index + 1);

/** The configuration of each joint. */
export const configurationsOf = ({ configuration }: Armed): Configuration[] => [
  configuration,
  ...(configuration.arm?.other_joints ?? []),
];

/** The session with configuration and actuator of a joint in place of those of joint 1. */
export function settingsOfJoint<T extends Armed>(state: T, joint: Joint): T {
  const arm = armOf(state);
  const configuration = arm?.other_joints[joint - 2];
  if (!arm || configuration === undefined) return state;
  const actuator = (state as Partial<SessionState>).other_actuators?.[joint - 2];
  const { comparisons } = state.configuration;
  return {
    ...state,
    configuration: { ...configuration, comparisons, arm },
    ...(actuator ? { actuator } : {}),
  };
}

/** The joint of a lane, from 1, of arms with this number of joints. */
export const jointOfLane = (lane: number, count: number): Joint => ((lane - 1) % count) + 1;

/** The server names a controller of an arm after its joint. */
export const nameWithoutJoint = (name: string): string => name.replace(/^Joint \d /, "");

/** The controllers of each arm by the names of its lanes: one name if all joints have the same. */
export const nameArms = (lanes: readonly string[], count: number): string[] =>
  lanes.flatMap((_, first) => {
    if (first % count !== 0) return [];
    const own = lanes.slice(first, first + count).map(nameWithoutJoint);
    return [[...new Set(own)].join(", ")];
  });
