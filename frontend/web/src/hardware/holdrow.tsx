import { useId } from "preact/hooks";
import type { BenchState } from "../core/api/types";
import { mayCommand, otherHolder } from "../core/state/control";
import { isLive } from "../core/state/session";
import { text } from "../core/text/en";
import {
  holdEnd,
  holdMessage,
  isSwitchHeld,
  pressInput,
  releaseInput,
  type SwitchInput,
} from "./hold";

const words = text.hold;
const isSwitchKey = (event: KeyboardEvent): boolean => event.key === " " || event.key === "Enter";

function press(event: PointerEvent & { currentTarget: HTMLElement }): void {
  if (event.button !== 0) return;
  event.currentTarget.setPointerCapture(event.pointerId);
  pressInput("pointer");
}

function pressKey(event: KeyboardEvent): void {
  if (event.ctrlKey || event.metaKey || event.altKey) releaseInput("button");
  else if (isSwitchKey(event)) {
    event.preventDefault();
    if (!event.repeat) pressInput("button");
  }
}

const releaseOn = (grip: SwitchInput) => () => releaseInput(grip);

/** On a bench that requires it: the switch that a user holds while the bench runs. */
export function HoldRow({ bench: { status } }: { bench: BenchState }) {
  const id = useId();
  const held = isSwitchHeld.value;
  const other = otherHolder.value;
  const label =
    other === null ? words.words[holdMessage(status, held, holdEnd.value)] : words.other(other);
  return (
    <section class="bar is-foot hold" aria-label={words.heading}>
      <button
        type="button"
        class="rigid strong hold-button"
        aria-pressed={held}
        aria-describedby={id}
        aria-keyshortcuts="d"
        title={words.keyHint}
        disabled={!mayCommand.value}
        onPointerDown={press}
        onPointerUp={releaseOn("pointer")}
        onPointerCancel={releaseOn("pointer")}
        onLostPointerCapture={releaseOn("pointer")}
        onContextMenu={(event) => event.preventDefault()}
        onKeyDown={pressKey}
        onKeyUp={(event) => {
          if (isSwitchKey(event)) releaseInput("button");
        }}
        onBlur={releaseOn("button")}
      >
        {words.button} <kbd>{words.key}</kbd>
      </button>
      <p id={id} role="status">
        <strong class={held ? "good" : "bad"}>
          <span aria-hidden="true">{held ? "●" : "○"}</span> {held ? words.held : words.notHeld}
        </strong>{" "}
        {isLive.value ? label : words.unheard}
      </p>
    </section>
  );
}
