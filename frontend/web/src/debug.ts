/**
 * `window.svsa`, an interface for the console and for tests: the samples that the plots draw, in SI units.
 *
 *     svsa.channels()                          names of the channels in the stream
 *     svsa.series("position_error_rad")        { time: [s …], value: [rad …] }, oldest first
 *     svsa.series("position_error_rad", 2)     the same of lane 2, NaN before the lane began
 *
 * The first and the last sample of a gap are NaN in every lane.
 */
import { samples } from "./core/state/session";

interface Series {
  time: number[];
  value: number[];
}

interface DebugAccess {
  channels(): string[];
  series(channel: string, lane?: number): Series;
}

declare global {
  interface Window {
    svsa: DebugAccess;
  }
}

function series(channel: string, lane = 1): Series {
  const { ring } = samples;
  if (!ring.channels.includes(channel)) {
    throw new RangeError(`"${channel}" is not streamed: it must be one of ${ring.channels}`);
  }
  if (!Number.isInteger(lane) || lane < 1 || lane > Math.max(1, ring.lanes)) {
    throw new RangeError(`lane ${lane} is not streamed: it must be from 1 to ${ring.lanes}`);
  }
  const time = new Float64Array(ring.length);
  const value = new Float32Array(ring.length);
  ring.copyTime(0, time);
  ring.copyChannel(channel, 0, value, 1, lane);
  return { time: Array.from(time), value: Array.from(value) };
}

export function installDebugAccess(): void {
  window.svsa = { channels: () => [...samples.ring.channels], series };
}
