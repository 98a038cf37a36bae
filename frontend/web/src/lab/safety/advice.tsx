import type { SessionFault } from "../../core/api/types";
import { text } from "../../core/text/en";

/** Why a fault happens and what to try; nothing if its message says it all. */
export function FaultAdvice({ fault: { advice } }: { fault: SessionFault }) {
  if (advice === null) return null;
  return (
    <details class="fault-advice">
      <summary>{text.fault.adviceTitle}</summary>
      {advice}
    </details>
  );
}
