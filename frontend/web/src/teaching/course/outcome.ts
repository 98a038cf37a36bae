/**
 * The errors of a figure's run, for its picture. The first of every pair is FL, the second NDOBC.
 */
import type { Batch } from "../../core/stream/decoder";

export interface ErrorHistory {
  timeS: number[];
  positionRad: [number[], number[]];
}

/** The columns time and position error of two lanes. */
export function errorHistoryOf({ count, lanes, values }: Batch, channels: number): ErrorHistory {
  const read = (channel: number, lane: number) =>
    Array.from(
      { length: count },
      (_, index) => values[(index * lanes.length + lane) * channels + channel] as number,
    );
  return {
    timeS: read(0, 0),
    positionRad: [read(1, 0), read(1, 1)],
  };
}
