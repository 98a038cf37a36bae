/** Runs of an overlay judged against one of them: within tolerances of value and time, or when not. */
import { judgeRun } from "../../core/api/runs";
import type { RunVerdict, VerdictRequest } from "../../core/api/types";
import { type Alignment, CHANNELS, FACTORS, type Overlaid, type OverlayChannel } from "./overlaid";

const POINTS = 4000;

/** By how much a channel may differ: in its unit on screen, in per cent, in seconds. */
export interface Bounds {
  absolute: number;
  relativePercent: number;
  timeS: number;
}
export type Tolerances = Readonly<Record<OverlayChannel, Bounds>>;

export interface Judged {
  run: string;
  reference: string;
  verdict: RunVerdict;
}

/** A curve that left its band, or did not, in the overlay's time and units. */
export interface JudgedCurve {
  curve: Overlaid;
  channel: OverlayChannel;
  isHeld: boolean;
  worstS: number;
  value: number | null;
  low: number | null;
  high: number | null;
  /** From when to when. */
  outside: readonly (readonly [number, number])[];
  outsideS: number;
}

/** What a channel may be. */
export interface BandShown {
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

/** Every other run against the reference, laid over it as in the plots. */
export function judgeRuns(
  runs: readonly string[],
  reference: string,
  tolerances: Tolerances,
  align: Alignment,
): Promise<Judged[]> {
  const wanted = buildRequest(reference, tolerances, align);
  const others = runs.filter((run) => run !== reference);
  return Promise.all(
    others.map(async (run) => ({ run, reference, verdict: await judgeRun(run, wanted) })),
  );
}

const scale = (value: number | null, channel: OverlayChannel): number | null =>
  value === null ? null : value * FACTORS[channel];

export function listJudged(curves: readonly Overlaid[], judged: readonly Judged[]): JudgedCurve[] {
  return judged.flatMap(({ run, verdict }) =>
    verdict.channels.flatMap((one) => {
      const curve = curves.find((each) => each.run === run && each.laneId === one.lane);
      const channel = CHANNELS.find((name) => name === one.channel);
      if (curve === undefined || channel === undefined) return [];
      return {
        curve,
        channel,
        isHeld: one.held,
        worstS: one.worst_s - curve.zeroS,
        value: scale(one.value, channel),
        low: scale(one.low, channel),
        high: scale(one.high, channel),
        outside: one.outside.map(([from, to]) => [from - curve.zeroS, to - curve.zeroS] as const),
        outsideS: one.outside_s,
      };
    }),
  );
}

/** Of each lane of the reference the longest band that was asked for: they differ in length alone. */
export function listBands(
  curves: readonly Overlaid[],
  judged: readonly Judged[],
  channel: OverlayChannel,
): BandShown[] {
  const zero = curves.find(({ run }) => run === judged[0]?.reference)?.zeroS ?? 0;
  const longest = new Map<string, BandShown>();
  for (const { verdict } of judged) {
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
