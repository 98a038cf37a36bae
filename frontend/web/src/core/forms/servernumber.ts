/** Numbers of the server while the user changes them. */
import { useRef, useState } from "preact/hooks";
import type { SessionRequest } from "../api/client";
import { RefusedError } from "../api/errors";
import type { SessionState } from "../api/types";
import { perform, problem } from "../state/actions";
import { session } from "../state/session";

export interface ServerNumber {
  /** Name of the control, unique on the page. */
  name: string;
  /** Value on the server, in the unit on screen. */
  value: number;
  send: (value: number) => SessionRequest;
}

/**
 * A number of the server: commits are sent one after the other, of several that wait only the last.
 * `edits` goes on an element around the controls.
 */
export function useServerNumber({ name, value, send }: ServerNumber) {
  /** Position of a slider that is moved. */
  const [dragged, setDragged] = useState<number | null>(null);
  const stateAtStart = useRef<SessionState | null>(null);
  const waiting = useRef<number | null>(null);
  const sending = useRef<Promise<boolean> | null>(null);

  const sendAll = async () => {
    let isTaken = true;
    while (waiting.current !== null) {
      const next = waiting.current;
      waiting.current = null;
      isTaken = await perform(
        name,
        (edit) => send(next)(edit),
        stateAtStart.current ?? session.peek(),
      );
      stateAtStart.current = null;
    }
    sending.current = null;
    return isTaken || !(problem.peek()?.error instanceof RefusedError);
  };
  const commit = (next: number): Promise<boolean> => {
    waiting.current = next;
    sending.current ??= sendAll();
    return sending.current;
  };
  const edits = {
    onInput: () => {
      stateAtStart.current ??= session.peek();
    },
    onFocusOut: () => {
      if (sending.current === null) stateAtStart.current = null;
    },
    onKeyDown: (event: KeyboardEvent) => {
      if (event.key === "Escape" && problem.peek()?.control === name) problem.value = null;
    },
  };
  return {
    shown: dragged ?? value,
    drag: setDragged,
    commit,
    release: (next: number) => commit(next).then(() => setDragged(null)),
    edits,
  };
}
