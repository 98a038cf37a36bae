/** The arm of a session: its joints, their settings and their lanes. */
import type { ArmSetup } from "../api/arm";
import type { Joint, SessionState } from "../api/types";

export type Armed = Pick<SessionState, "configuration">;

/** The arm of a session; null for a single joint. */
export const armOf = ({ configuration }: Armed): ArmSetup | null => configuration.arm ?? null;

/** The session with configuration and actuator of a joint in place of those of joint 1. */
export function settingsOfJoint<T extends Armed>(state: T, joint: Joint): T {
  const arm = armOf(state);
  if (arm === null || joint === 1) return state;
  const { actuator2 } = state as Partial<SessionState>;
  const { comparisons } = state.configuration;
  return {
    ...state,
    configuration: { ...arm.joint2, comparisons, arm },
    ...(actuator2 ? { actuator: actuator2 } : {}),
  };
}

/** Lanes, from 1: joint 1 and joint 2 of the arm, then those of the comparison. */
export const LANES_OF_ARM = 2;

export const jointOfLane = (lane: number): Joint => (lane % LANES_OF_ARM === 1 ? 1 : 2);

/** The server names a controller of an arm after its joint. */
export const nameWithoutJoint = (name: string): string => name.replace(/^Joint [12] /, "");

/** The controllers of each arm by the names of its lanes: one name if both joints have the same. */
export const nameArms = (lanes: readonly string[]): string[] =>
  lanes.flatMap((_, first) => {
    if (first % LANES_OF_ARM !== 0) return [];
    const pair = lanes.slice(first, first + LANES_OF_ARM).map(nameWithoutJoint);
    return [[...new Set(pair)].join(", ")];
  });
