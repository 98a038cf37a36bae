/** Channels of a run by plot: the live page's plots, with one selection per quantity. */
import type { Joint, StreamedName } from "../../core/api/types";
import { CHANNELS, type ChannelName, PRESETS, spanOf, unitOf } from "../../core/plots/channels";
import { ownerOf, type Trace } from "../../core/plots/definitions";
import { composeOfJoint } from "../../core/plots/joints";
import { listJoints } from "../../core/state/joints";
import { t } from "../../core/text/t";
import type { Recording } from "./data";

/** The pieces of a curve are one array, with NaN while its controller was not in control. */
export interface Curve extends Trace {
  values: Float32Array;
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

/** Extract a piece of a curve from its lane's samples. */
function copyPiece(into: Float32Array, { arrays, run }: Recording, trace: Trace): void {
  const numbers = run.curves.channels[trace.channel as StreamedName] ?? [];
  const values = arrays[numbers[trace.lane - 1] ?? -1];
  const sampleAt = (timeS: number) =>
    Math.min(into.length, Math.max(0, Math.ceil(timeS / run.curves.step_s - 1e-6)));
  for (let index = sampleAt(trace.from); index < sampleAt(trace.to); index++) {
    into[index] = (values?.[index] ?? Number.NaN) * trace.factor;
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
    };
    copyPiece(known.values, recording, trace);
    curves.set(key, known);
  }
  return [...curves.values()];
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
  const isRecorded = (name: ChannelName) => Object.hasOwn(curves.channels, name);
  const count = recording.run.arm?.chain.length ?? 1;
  const joints: readonly (Joint | null)[] = recording.run.arm === null ? [null] : listJoints(count);
  return SHOWN.flatMap((preset) => joints.map((joint) => ({ preset, joint })))
    .map(({ preset, joint }) => {
      const channels = PRESETS[preset].filter(isRecorded);
      const belongs = (leader: string) => (name: ChannelName) =>
        name === leader || CHANNELS[name].truthOf === leader || CHANNELS[name].isReference;
      const title = t(`plots.presets.${preset}`);
      return {
        key: joint === null ? preset : `${preset}.${joint}`,
        title: joint === null ? title : t("plots.ofJoint", { joint, title }),
        unit: unitOf(channels),
        span: spanOf(channels),
        choices: composeOfJoint(channels, cast, joint, count).groups.map(({ key, label }) => {
          const { groups, common } = composeOfJoint(
            channels.filter(belongs(key)),
            cast,
            joint,
            count,
          );
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
