/** The window of the first load of a recorded run. */
import type { RunDetails, WindowState } from "../api/types";

type Recorded = Pick<RunDetails, "windows" | "first_tick" | "ticks">;

/** From the load's onset to the next change; null where no load came while it was recorded. */
export function findLoad({ windows, first_tick: first, ticks }: Recorded): WindowState | null {
  const isRecorded = ({ start_tick: tick }: WindowState) => tick >= first && tick < first + ticks;
  return windows.find((window) => window.kind === "load" && isRecorded(window)) ?? null;
}
