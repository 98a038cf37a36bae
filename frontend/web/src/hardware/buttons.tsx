import {
  armBench,
  clearBench,
  pause,
  restartBench,
  type SessionRequest,
  start,
} from "../core/api/client";
import type { BenchState } from "../core/api/types";
import { perform } from "../core/state/actions";
import { mayCommand } from "../core/state/control";
import { isLive } from "../core/state/session";
import { t } from "../core/text/t";
import { isSwitchHeld } from "./hold";
import { type AllowedCommands, allowedCommands, isLoopLost } from "./status";

interface Action {
  name: Exclude<keyof AllowedCommands, "home">;
  label: string;
  hint: string;
  send: SessionRequest;
}

const ACTIONS: readonly Action[] = [
  { name: "arm", label: t("bench.arm"), hint: t("bench.armHint"), send: armBench },
  { name: "run", label: t("bench.run"), hint: t("bench.runHint"), send: start },
  { name: "stop", label: t("bench.stop"), hint: t("bench.stopHint"), send: pause },
  { name: "clear", label: t("bench.clear"), hint: t("bench.clearHint"), send: clearBench },
];

const RESTART: Action = {
  name: "restart",
  label: t("bench.restart"),
  hint: t("bench.restartHint"),
  send: restartBench,
};

/** A lost loop has no fault to clear: it is restarted. */
const actionsOn = (bench: BenchState): readonly Action[] =>
  isLoopLost(bench)
    ? ACTIONS.map((action) => (action.name === "clear" ? RESTART : action))
    : ACTIONS;

/**
 * Commands from one state of the bench to the next; the next step is highlighted. Every user may
 * stop.
 */
export function BenchButtons({ bench }: { bench: BenchState }) {
  const allowed = allowedCommands(bench, isSwitchHeld.value);
  return (
    <fieldset class="row tight" disabled={!isLive.value} aria-label={t("bench.heading")}>
      {actionsOn(bench).map(({ name, label, hint, send }) => {
        const isAllowed = allowed[name] && (name === "stop" || mayCommand.value);
        return (
          <button
            key={name}
            type="button"
            class={`button ${isAllowed ? "is-primary" : ""}`}
            disabled={!isAllowed}
            title={hint}
            aria-keyshortcuts={name === "stop" ? "Space" : undefined}
            onClick={() => void perform("bench", send)}
          >
            {label}
          </button>
        );
      })}
    </fieldset>
  );
}
