/** The curves of one joint of an arm: those of its lanes, under the names of the controllers. */
import type { Joint } from "../api/types";
import { jointOfLane, listJoints, nameWithoutJoint } from "../state/joints";
import type { LaneSegments } from "../state/lanes";
import type { ChannelName } from "./channels";
import type { PlotContent, Trace } from "./definitions";
import { composeContent } from "./traces";

/** The lanes of a joint of arms of `joints`, by their numbers from 1; all lanes without one. */
export const lanesOfJoint = (lanes: number, joint: Joint | null, joints: number): number[] =>
  listJoints(lanes).filter((lane) => joint === null || jointOfLane(lane, joints) === joint);

/** As `composeContent`, of the lanes of a joint; of all lanes for null. */
export function composeOfJoint(
  channels: readonly ChannelName[],
  cast: LaneSegments,
  joint: Joint | null,
  joints: number,
  isBench?: boolean,
): PlotContent {
  if (joint === null) return composeContent(channels, cast, isBench);
  const lanes = lanesOfJoint(cast.length, joint, joints);
  const own = lanes.map((lane) =>
    (cast[lane - 1] ?? []).map((segment) => ({ ...segment, name: nameWithoutJoint(segment.name) })),
  );
  const { groups, common } = composeContent(channels, own, isBench);
  const move = (trace: Trace): Trace => ({ ...trace, lane: lanes[trace.lane - 1] ?? trace.lane });
  return {
    groups: groups.map((group) => ({ ...group, traces: group.traces.map(move) })),
    common: common.map(move),
  };
}
