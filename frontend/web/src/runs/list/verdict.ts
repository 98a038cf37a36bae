/**
 * Runs of an overlay compared with a reference run: within tolerances of value and time, or the
 * first deviation.
 */
import { assessRun } from "../../core/api/runs";
import type { RunVerdict, VerdictRequest } from "../../core/api/types";
import {
  type Alignment,
  CHANNELS,
  FACTORS,
  type OverlayChannel,
  type OverlayCurve,
} from "./overlaycurves";

const POINTS = 4000;

/** Tolerance of a channel: in its unit on screen, in percent, in seconds. */
export interface Bounds {
  absolute: number;
  relativePercent: number;
  timeS: number;
}
export type Tolerances = Readonly<Record<OverlayChannel, Bounds>>;

export interface RunAssessment {
  run: string;
  reference: string;
  verdict: RunVerdict;
}

/** Result of a curve in the overlay's time and units. */
export interface CurveAssessment {
  curve: OverlayCurve;
  channel: OverlayChannel;
  isWithin: boolean;
  worstS: number;
  value: number | null;
  low: number | null;
  high: number | null;
  /** Start and end. */
  outside: readonly (readonly [number, number])[];
  outsideS: number;
}

/** Tolerances of a channel. */
export interface ToleranceBand {
  time: readonly number[];
  low: readonly (number | null)[];
  high: readonly (number | null)[];
}

export const buildRequest = (
  reference: string,
  tolerances: Tolerances,
  align: Alignment,
): VerdictRequest => ({
  other: reference,
  tolerances: Object.fromEntries(
    CHANNELS.map((channel) => {
      const { absolute, relativePercent, timeS } = tolerances[channel];
      const own = { absolute: absolute / FACTORS[channel], relative: relativePercent / 100 };
      return [channel, { ...own, time_s: timeS }];
    }),
  ),
  rest: null,
  align,
  points: POINTS,
});

/** Every other run against the reference, aligned as in the plots. */
export function assessRuns(
  runs: readonly string[],
  reference: string,
  tolerances: Tolerances,
  align: Alignment,
): Promise<RunAssessment[]> {
  const request = buildRequest(reference, tolerances, align);
  const others = runs.filter((run) => run !== reference);
  return Promise.all(
    others.map(async (run) => ({ run, reference, verdict: await assessRun(run, request) })),
  );
}

const scale = (value: number | null, channel: OverlayChannel): number | null =>
  value === null ? null : value * FACTORS[channel];

export function listAssessments(
  curves: readonly OverlayCurve[],
  assessments: readonly RunAssessment[],
): CurveAssessment[] {
  return assessments.flatMap(({ run, verdict }) =>
    verdict.channels.flatMap((channelResult) => {
      const curve = curves.find((each) => each.run === run && each.laneId === channelResult.lane);
      const channel = CHANNELS.find((name) => name === channelResult.channel);
      if (curve === undefined || channel === undefined) return [];
      return {
        curve,
        channel,
        isWithin: channelResult.held,
        worstS: channelResult.worst_s - curve.zeroS,
        value: scale(channelResult.value, channel),
        low: scale(channelResult.low, channel),
        high: scale(channelResult.high, channel),
        outside: channelResult.outside.map(
          ([from, to]) => [from - curve.zeroS, to - curve.zeroS] as const,
        ),
        outsideS: channelResult.outside_s,
      };
    }),
  );
}

/** The longest band of each lane of the reference: the bands differ only in length. */
export function listBands(
  curves: readonly OverlayCurve[],
  assessments: readonly RunAssessment[],
  channel: OverlayChannel,
): ToleranceBand[] {
  const zero = curves.find(({ run }) => run === assessments[0]?.reference)?.zeroS ?? 0;
  const longest = new Map<string, ToleranceBand>();
  for (const { verdict } of assessments) {
    for (const [lane, band] of Object.entries(verdict.bands[channel] ?? {})) {
      const last = band.time_s.at(-1) ?? 0;
      if (last - zero <= (longest.get(lane)?.time.at(-1) ?? Number.NEGATIVE_INFINITY)) continue;
      longest.set(lane, {
        time: band.time_s.map((seconds) => seconds - zero),
        low: band.low.map((value) => scale(value, channel)),
        high: band.high.map((value) => scale(value, channel)),
      });
    }
  }
  return [...longest.values()];
}
