/** What a run says to the paper's claims. Of every pair the first is FL, the second NDOBC. */
import type { Figure } from "../../core/api/types";
import type { Batch } from "../../core/stream/decoder";
import { toDegrees } from "../../core/units";

export interface Course {
  timeS: number[];
  positionRad: [number[], number[]];
  stiffness: [number[], number[]];
}

export interface Numbers {
  beforeDeg: number;
  peakDeg: number;
  steadyDeg: number;
  stiffnessBefore: number;
  stiffnessSteady: number;
}

export type Part =
  | "alikeBefore"
  | "flPoor"
  | "ndobcGoesOn"
  | "stiffnessKept"
  | "bothGrow"
  | "ndobcBetter";

export interface Finding {
  part: Part;
  holds: boolean;
}

const BEFORE_S = [1, 5] as const;
const PEAK_S = [5, 7] as const;
const STEADY_S = [8, 20] as const;
const SMALL_DEG = 0.1;
const UNMOVED = 0.01;
const MUCH = 10;
const FAR = 100;

/** The columns time, position error and stiffness error of two lanes. */
export function sliceCourse({ count, lanes, values }: Batch, channels: number): Course {
  const read = (channel: number, lane: number) =>
    Array.from(
      { length: count },
      (_, index) => values[(index * lanes.length + lane) * channels + channel] as number,
    );
  return {
    timeS: read(0, 0),
    positionRad: [read(1, 0), read(1, 1)],
    stiffness: [read(2, 0), read(2, 1)],
  };
}

function within(
  timeS: readonly number[],
  values: readonly number[],
  [from, to]: readonly [number, number],
): number[] {
  return values.filter((_, index) => {
    const time = timeS[index] as number;
    return time >= from - 1e-6 && time < to - 1e-6;
  });
}

const rms = (values: readonly number[]) =>
  Math.sqrt(values.reduce((sum, value) => sum + value * value, 0) / values.length);
const peak = (values: readonly number[]) =>
  values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);

export function measure(course: Course, law: 0 | 1): Numbers {
  const { timeS } = course;
  const position = course.positionRad[law];
  const stiffness = course.stiffness[law];
  return {
    beforeDeg: toDegrees(rms(within(timeS, position, BEFORE_S))),
    peakDeg: toDegrees(peak(within(timeS, position, PEAK_S))),
    steadyDeg: toDegrees(rms(within(timeS, position, STEADY_S))),
    stiffnessBefore: rms(within(timeS, stiffness, BEFORE_S)),
    stiffnessSteady: rms(within(timeS, stiffness, STEADY_S)),
  };
}

/** Each part of what the paper says of the figure, and whether it holds. NaN holds nothing. */
export function judge(figure: Figure, fl: Numbers, ndobc: Numbers): Finding[] {
  const alikeBefore = fl.beforeDeg < SMALL_DEG && ndobc.beforeDeg < SMALL_DEG;
  if (figure === "5") {
    const grows =
      fl.steadyDeg > MUCH * fl.beforeDeg && fl.stiffnessSteady > MUCH * fl.stiffnessBefore;
    const isBetter =
      fl.steadyDeg > FAR * ndobc.steadyDeg && fl.stiffnessSteady > FAR * ndobc.stiffnessSteady;
    return [
      { part: "alikeBefore", holds: alikeBefore },
      { part: "bothGrow", holds: grows },
      { part: "ndobcBetter", holds: isBetter },
    ];
  }
  return [
    { part: "alikeBefore", holds: alikeBefore },
    { part: "flPoor", holds: fl.steadyDeg > MUCH * fl.beforeDeg },
    { part: "ndobcGoesOn", holds: ndobc.steadyDeg < 2 * ndobc.beforeDeg },
    { part: "stiffnessKept", holds: ndobc.stiffnessSteady < UNMOVED },
  ];
}
