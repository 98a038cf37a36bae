import { useCallback } from "preact/hooks";
import type { LaneRow } from "../core/api/types";
import { samples } from "../core/state/session";
import { formatNumber, toDegrees } from "../core/units";
import { useLiveText } from "../core/widgets/live";
import { readCurrentError } from "./window";

/** The position error of a lane at the newest sample of its controller, in degrees. */
export function CurrentError({ of, maxDigits }: { of: LaneRow | undefined; maxDigits: number }) {
  const lane = of?.lane ?? 1;
  const startS = of?.segments.at(-1)?.start_s ?? 0;
  const read = useCallback(
    () => formatNumber(toDegrees(readCurrentError(samples.ring, lane, startS)), 3, maxDigits),
    [lane, startS, maxDigits],
  );
  const element = useLiveText<HTMLSpanElement>(read);
  return <span ref={element} />;
}
