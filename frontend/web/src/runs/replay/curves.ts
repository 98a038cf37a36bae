/** Which channels are drawn where, for the lanes of a run. A new plot is a new entry here. */
import type { StreamedName } from "../../core/api/types";
import type { PlotColour } from "../../core/plots/definitions";
import { lineStyleOf } from "../../core/plots/linestyles";
import { text } from "../../core/text/replay";
import { DEGREES_PER_RADIAN } from "../../core/units";
import type { LaneStretch, Recording } from "./data";

export interface Curve {
  key: string;
  label: string;
  colour: PlotColour;
  dash: readonly number[];
  width: number;
  values: Float32Array;
  /** Drawn and hidden together with this curve, and covered by its entry in the legend. */
  follows?: string;
}

/** One set of curves of a plot; where there are several, the reader chooses. */
interface Choice {
  label: string;
  curves: Curve[];
}

export interface ReplayPlot {
  key: string;
  title: string;
  unit: string;
  /** The axis never shows less than this. */
  span: number;
  choices: Choice[];
}

const REFERENCE = { colour: "reference", width: 1.5 } as const;
const REFERENCE_DASHES = [
  [2, 4],
  [7, 4],
  [1, 2],
  [10, 3, 2, 3],
] as const;

const { channelLabels: labels, plots } = text;

/** Copies what a controller did; where it was not in control there is no number. */
function copyStretch(
  values: Float32Array,
  { start_s: from, end_s: to }: LaneStretch,
  stepS: number,
  into: Float32Array,
): Float32Array {
  const first = Math.ceil(from / stepS - 1e-6);
  const end = Math.ceil(to / stepS - 1e-6);
  into.set(values.subarray(first, end), first);
  return into;
}

export function definePlots(recording: Recording): ReplayPlot[] {
  const { run, arrays } = recording;

  const read = (channel: StreamedName, factor: number): Float32Array[] => {
    const numbers = run.curves.channels[channel] ?? [];
    const scaled = new Map<number, Float32Array>();
    for (const number of numbers) {
      const values = arrays[number] as Float32Array;
      scaled.set(number, factor === 1 ? values : values.map((value) => value * factor));
    }
    return numbers.map((number) => scaled.get(number) as Float32Array);
  };
  const lanes = (channel: StreamedName, factor: number): Curve[] => {
    const curves = new Map<number, Curve>();
    for (const [lane, values] of read(channel, factor).entries()) {
      const stretches = run.stretches[lane] ?? [];
      for (const stretch of stretches) {
        const { number, name, line_style: lineStyle } = stretch;
        const known = curves.get(number);
        const isWhole = stretches.length === 1 && known === undefined;
        const into = known?.values ?? new Float32Array(values.length).fill(Number.NaN);
        const own = isWhole ? values : copyStretch(values, stretch, run.curves.step_s, into);
        curves.set(number, {
          key: `${channel}.${number}`,
          label: name,
          ...lineStyleOf(lineStyle),
          values: own,
        });
      }
    }
    return [...curves.values()];
  };
  const reference = (channel: StreamedName, factor: number): Curve[] =>
    read(channel, factor)
      .slice(0, 1)
      .map((values) => ({
        key: channel,
        label: plots.reference,
        ...REFERENCE,
        dash: REFERENCE_DASHES[0],
        values,
      }));
  /** The load on a lane may depend on where the lane is: one curve for all that are equal. */
  const truth = (channel: StreamedName): Curve[] =>
    [...new Set(read(channel, 1))].map((values, index) => ({
      key: `${channel}.${index}`,
      label: plots.true,
      ...(index > 0 ? { follows: `${channel}.0` } : {}),
      ...REFERENCE,
      dash: REFERENCE_DASHES[index % REFERENCE_DASHES.length] as readonly number[],
      values,
    }));
  const one = (...curves: Curve[][]): Choice[] => [{ label: "", curves: curves.flat() }];
  const load = (name: "link" | "motor1" | "motor2"): Choice => ({
    label: labels[`estimate_${name}_nm`],
    curves: [...lanes(`estimate_${name}_nm`, 1), ...truth(`disturbance_${name}_nm`)],
  });

  const all: ReplayPlot[] = [
    {
      key: "position",
      title: plots.presets.position,
      unit: "deg",
      span: 2,
      choices: one(
        lanes("position_rad", DEGREES_PER_RADIAN),
        reference("position_reference_rad", DEGREES_PER_RADIAN),
      ),
    },
    {
      key: "error",
      title: plots.presets.error,
      unit: "deg",
      span: 0.004,
      choices: one(lanes("position_error_rad", DEGREES_PER_RADIAN)),
    },
    {
      key: "stiffness",
      title: plots.presets.stiffness,
      unit: "N·m/rad",
      span: 2,
      choices: one(
        lanes("stiffness_nm_per_rad", 1),
        reference("stiffness_reference_nm_per_rad", 1),
      ),
    },
    {
      key: "torque",
      title: plots.presets.torque,
      unit: "N·m",
      span: 1,
      choices: [
        { label: labels.torque1_nm, curves: lanes("torque1_nm", 1) },
        { label: labels.torque2_nm, curves: lanes("torque2_nm", 1) },
      ],
    },
    {
      key: "disturbance",
      title: plots.presets.disturbance,
      unit: "N·m",
      span: 1,
      choices: [load("link"), load("motor1"), load("motor2")],
    },
  ];
  return all
    .map((plot) => ({ ...plot, choices: plot.choices.filter((choice) => choice.curves.length) }))
    .filter((plot) => plot.choices.length > 0);
}

/** The time axis of every curve: equal steps, the last point at the end of the run. */
export function makeTimeAxis({ run }: Recording): Float64Array {
  const any = Object.values(run.curves.channels)[0]?.[0] ?? 0;
  const count = run.arrays.places[any]?.[1] ?? 0;
  return Float64Array.from({ length: count }, (_, index) => index * run.curves.step_s);
}
