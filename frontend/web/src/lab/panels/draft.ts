/** Typed values before the server has accepted them. */
import { useRef, useState } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { perform, problem } from "../../core/state/actions";
import { session } from "../../core/state/session";
import { text } from "../../core/text/en";
import { formatInput } from "../../core/units";

export interface ServerNumber {
  /** Name of the control, unique on the page. */
  name: string;
  /** Value on the server, in the unit on screen. */
  value: number;
  send: (value: number) => Promise<SessionState>;
}

/**
 * A number of the server. Typing makes a draft; leaving the field discards it, Enter sends it; then
 * the server's value is shown again.
 */
export function useDraft({ name, value, send }: ServerNumber) {
  const [draft, storeDraft] = useState<string | null>(null);
  const stateAtStart = useRef<SessionState | null>(null);
  const setDraft = (next: string | null) => {
    if (draft === null) stateAtStart.current = session.peek();
    storeDraft(next);
  };
  const commit = async (next: string) => {
    const number = Number(next);
    if (next.trim() === "" || !Number.isFinite(number)) {
      problem.value = { control: name, message: text.refusal.noNumber };
    } else if (next !== formatInput(value)) {
      setDraft(next);
      await perform(name, () => send(number), stateAtStart.current);
    }
    storeDraft((current) => (current === null || current === next ? null : current));
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
