/** Channels of a run by plot: the live page's plots, with one selection per quantity. */
import type { Joint } from "../../core/api/types";
import { CHANNELS, type ChannelName, PRESETS, spanOf, unitOf } from "../../core/plots/channels";
import { ownerOf, type Trace } from "../../core/plots/definitions";
import { describeEstimate, ESTIMATE } from "../../core/plots/estimate";
import { composeOfJoint } from "../../core/plots/joints";
import { listJoints } from "../../core/state/joints";
import {
  derive,
  isDerived,
  orMissing,
  type ReadChannel,
  sourcesOf,
} from "../../core/stream/derived";
import { t } from "../../core/text/t";
import type { Recording } from "./data";

/** The pieces of a curve are one array, with NaN while its controller was not in control. */
export interface Curve extends Trace {
  values: Float32Array;
  /** Text of a sample of the stiffness estimate, in place of its value. */
  describe?: (index: number) => string;
}

/** One set of curves of a plot; if there are several, the user selects one. */
interface Choice {
  label: string;
  curves: Curve[];
}

export interface ReplayPlot {
  key: string;
  title: string;
  unit: string;
  /** Minimum range of the axis. */
  span: number;
  choices: Choice[];
}

const SHOWN = ["position", "error", "stiffness", "torque", "disturbance"] as const;

/** The channels of a lane in one sample. */
const readerAt =
  ({ arrays, run }: Recording, lane: number, index: number): ReadChannel =>
  (channel) => {
    const value = arrays[run.curves.channels[channel]?.[lane - 1] ?? -1]?.[index];
    return orMissing(channel, value ?? Number.NaN);
  };

/** Extract a piece of a curve from its lane's samples. */
function copyPiece(into: Float32Array, recording: Recording, trace: Trace): void {
  const { run } = recording;
  const channel = trace.channel as ChannelName;
  const sampleAt = (timeS: number) =>
    Math.min(into.length, Math.max(0, Math.ceil(timeS / run.curves.step_s - 1e-6)));
  for (let index = sampleAt(trace.from); index < sampleAt(trace.to); index++) {
    const read = readerAt(recording, trace.lane, index);
    into[index] = (isDerived(channel) ? derive(channel, read) : read(channel)) * trace.factor;
  }
}

function joinPieces(recording: Recording, traces: readonly Trace[]): Curve[] {
  const { length } = makeTimeAxis(recording);
  const curves = new Map<string, Curve>();
  for (const trace of traces) {
    const key = ownerOf(trace);
    const known = curves.get(key) ?? {
      ...trace,
      values: new Float32Array(length).fill(Number.NaN),
      ...(trace.channel === ESTIMATE && {
        describe: (index: number) => describeEstimate(readerAt(recording, trace.lane, index)),
      }),
    };
    copyPiece(known.values, recording, trace);
    curves.set(key, known);
  }
  // The last curve is on top.
  const isEstimate = ({ channel }: Curve) => Number(channel === ESTIMATE);
  return [...curves.values()].sort((first, second) => isEstimate(first) - isEstimate(second));
}

/** Of an arm a plot for each joint. */
export function definePlots(recording: Recording): ReplayPlot[] {
  const { segments, curves } = recording.run;
  const cast = segments.map((lane) =>
    lane.map(({ number, name, start_s: from, end_s: to, ...more }) => {
      const { line_style: lineStyle, has_estimate: hasEstimate } = more;
      return { number, name, lineStyle, hasEstimate, from, to };
    }),
  );
  const isBench = recording.run.plant !== "simulated";
  const isNumber = (number: number) =>
    recording.arrays[number]?.some((value) => !Number.isNaN(orMissing(ESTIMATE, value)));
  const isRecorded = (name: ChannelName) =>
    sourcesOf(name).every((source) => Object.hasOwn(curves.channels, source)) &&
    (name !== ESTIMATE || curves.channels[name]?.some(isNumber));
  const count = recording.run.arm?.chain.length ?? 1;
  const joints: readonly (Joint | null)[] = recording.run.arm === null ? [null] : listJoints(count);
  return SHOWN.flatMap((preset) => joints.map((joint) => ({ preset, joint })))
    .map(({ preset, joint }) => {
      const channels = PRESETS[preset].filter(isRecorded);
      const compose = (some: readonly ChannelName[]) =>
        composeOfJoint(some, cast, joint, count, isBench);
      const belongs = (leader: string) => (name: ChannelName) =>
        [name, CHANNELS[name].truthOf, CHANNELS[name].estimateOf].includes(leader as ChannelName) ||
        CHANNELS[name].isReference;
      const title = t(`plots.presets.${preset}`);
      return {
        key: joint === null ? preset : `${preset}.${joint}`,
        title: joint === null ? title : t("plots.ofJoint", { joint, title }),
        unit: unitOf(channels),
        span: spanOf(channels),
        choices: compose(channels).groups.map(({ key, label }) => {
          const { groups, common } = compose(channels.filter(belongs(key)));
          const traces = groups.flatMap((group) => group.traces);
          return { label, curves: joinPieces(recording, [...traces, ...common]) };
        }),
      };
    })
    .filter(({ choices }) => choices.length > 0);
}

/** The time axis of every curve: equal steps, the last point at the end of the run. */
export function makeTimeAxis({ run }: Recording): Float64Array {
  const any = Object.values(run.curves.channels)[0]?.[0] ?? 0;
  const count = run.arrays.places[any]?.[1] ?? 0;
  return Float64Array.from({ length: count }, (_, index) => index * run.curves.step_s);
}
