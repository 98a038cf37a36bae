import { useId } from "preact/hooks";
import type { BenchState } from "../core/api/types";
import { mayCommand, otherHolder } from "../core/state/control";
import { isLive } from "../core/state/session";
import { t } from "../core/text/t";
import {
  holdEnd,
  holdMessage,
  isSwitchHeld,
  pressInput,
  releaseInput,
  type SwitchInput,
} from "./hold";

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
    other === null
      ? t(`hold.words.${holdMessage(status, held, holdEnd.value)}`)
      : t("hold.other", { name: other });
  return (
    <section class="bar is-foot hold" aria-label={t("hold.heading")}>
      <button
        type="button"
        class="button rigid hold-button"
        aria-pressed={held}
        aria-describedby={id}
        aria-keyshortcuts="d"
        title={t("hold.keyHint")}
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
        {t("hold.button")} <kbd>{t("hold.key")}</kbd>
      </button>
      <p id={id} role="status">
        <strong class={held ? "good" : "bad"}>
          <span aria-hidden="true">{held ? "●" : "○"}</span>{" "}
          {held ? t("hold.held") : t("hold.notHeld")}
        </strong>{" "}
        {isLive.value ? label : t("hold.unheard")}
      </p>
    </section>
  );
}
