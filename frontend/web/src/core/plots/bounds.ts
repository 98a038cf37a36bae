/** Fixed limits of what a plot shows, as the session has them now. */
import type { SessionState } from "../api/types";
import { text } from "../text/en";
import { CHANNELS, type ChannelName } from "./channels";
import type { Bound, Trace } from "./definitions";

/** One for each channel with a limit; in its curve's colour where there is one lane. */
export function boundsOf(traces: readonly Trace[], state: SessionState | null): Bound[] {
  if (state === null) return [];
  const isAlone = traces.every((trace) => trace.lane === 1);
  const limits = new Map<string, Bound>();
  for (const { channel, colour } of traces) {
    const name = channel as ChannelName;
    const value = CHANNELS[name].bound?.(state);
    if (value === undefined || limits.has(channel)) continue;
    limits.set(channel, {
      label: text.plots.limit(text.channelLabels[name]),
      value: value * CHANNELS[name].factor,
      colour: isAlone ? colour : "reference",
    });
  }
  return [...limits.values()];
}
