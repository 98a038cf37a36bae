import type { SessionState } from "../../core/api/types";
import { text } from "../../core/text/en";

/** Why a fault happens and what to try, for who wants to know; nothing where its message says all. */
export function FaultAdvice({ fault }: { fault: NonNullable<SessionState["fault"]> }) {
  const advice = text.fault.advice(fault.code, fault.values ?? {});
  if (advice === null) return null;
  return (
    <details class="fault-advice">
      <summary>{text.fault.adviceTitle}</summary>
      {advice}
    </details>
  );
}
