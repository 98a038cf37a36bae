/** What the user types before the server holds it. */
import { useRef, useState } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { perform, problem } from "../../core/state/actions";
import { session } from "../../core/state/session";
import { text } from "../../core/text/en";
import { formatInput } from "../../core/units";

export interface HeldNumber {
  /** Names the control among all others of the page. */
  name: string;
  /** What the server holds, in the unit on screen. */
  value: number;
  send: (value: number) => Promise<SessionState>;
}

/**
 * A number the server holds. Typing makes a draft; leaving the field drops it, Enter sends it;
 * then what the server holds is shown again.
 */
export function useDraft({ name, value, send }: HeldNumber) {
  const [draft, keepDraft] = useState<string | null>(null);
  const seen = useRef<SessionState | null>(null);
  const setDraft = (next: string | null) => {
    if (draft === null) seen.current = session.peek();
    keepDraft(next);
  };
  const commit = async (next: string) => {
    const number = Number(next);
    if (next.trim() === "" || !Number.isFinite(number)) {
      problem.value = { control: name, message: text.refusal.noNumber };
    } else if (next !== formatInput(value)) {
      setDraft(next);
      await perform(name, () => send(number), seen.current);
    }
    keepDraft((current) => (current === null || current === next ? null : current));
  };
  const shown = draft ?? formatInput(value);
  const inputProps = {
    type: "number" as const,
    step: "any",
    value: shown,
    onInput: (event: Event) => setDraft((event.currentTarget as HTMLInputElement).value),
    onChange: (event: Event) => void commit((event.currentTarget as HTMLInputElement).value),
    onBlur: () => setDraft(null),
    onKeyDown: (event: KeyboardEvent) => {
      if (event.key === "Escape") setDraft(null);
    },
  };
  return { shown, setDraft, commit, inputProps };
}
