/** Keyboard commands of the page in its current state. */
import { signal } from "@preact/signals";
import { pause } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { toggleZoom } from "../../core/plots/eventzoom";
import { perform } from "../../core/state/actions";
import {
  CONTROL,
  toggleCompare,
  toggleRecording,
  toggleRun,
  toggleWeight,
} from "../../core/state/commands";
import { areKeysOn } from "../../core/state/preferences";
import { isLive, session } from "../../core/state/session";
import { closeNewest } from "../../core/widgets/panel";
import { isSwitchEffective, pressInput, releaseInput } from "../../hardware/hold";
import { place, toggleRuns } from "../../runs/list/place";
import { pressStop } from "../safety/stop";
import { toggleNames } from "../scene/viewer";
import { toggleDrawer } from "../script/drawer";
import { type Command, endsHold, findCommand, focusOf } from "./shortcuts";

const HOLD_GRIP = "key";
export const isHelpOpen = signal(false);

type SessionCommand = Exclude<
  Command,
  "hold" | "zoom" | "names" | "stop" | "runs" | "calls" | "help" | "close"
>;

/** No key starts a motor: on a bench Space only stops. */
function answerRun(state: SessionState): Promise<boolean> | undefined {
  if (state.bench === null) return state.status === "fault" ? undefined : toggleRun(state);
  return state.bench.status === "run" ? perform(CONTROL.session, pause) : undefined;
}

const answers: Record<SessionCommand, (state: SessionState) => Promise<boolean> | undefined> = {
  run: answerRun,
  record: toggleRecording,
  load: (state) => (state.status === "fault" ? undefined : toggleWeight()),
  compare: (state) => (state.recording === null ? toggleCompare(state) : undefined),
};

/** A key waits for the answer to the previous one, so that two presses are two commands. */
let answered: Promise<unknown> = Promise.resolve();

async function answerSession(command: SessionCommand): Promise<void> {
  const state = session.peek();
  if (state === null || !isLive.peek() || place.peek().kind !== "lab") return;
  await answers[command](state);
}

/** Handle a key; also registered in the document inside the 3D view. */
export function answerKey(event: KeyboardEvent): void {
  const focus = focusOf(event.target);
  if (endsHold(event, focus)) releaseInput(HOLD_GRIP);
  const command = findCommand(event, focus, areKeysOn.peek());
  if (command === null || (command === "close" && !closeNewest())) return;
  // The page would not receive the release of a key inside the 3D view.
  if (command === "hold" && !(isSwitchEffective() && event.view === window)) return;
  event.preventDefault();
  event.stopPropagation();
  if (command === "stop") void pressStop();
  else if (command === "hold") pressInput(HOLD_GRIP);
  else if (command === "zoom") toggleZoom();
  else if (command === "names") toggleNames();
  else if (command === "runs") toggleRuns();
  else if (command === "calls") toggleDrawer();
  else if (command === "help") isHelpOpen.value = !isHelpOpen.peek();
  else if (command !== "close") answered = answered.then(() => answerSession(command));
}

export function listenToKeys(): void {
  window.addEventListener("keydown", answerKey, true);
  window.addEventListener(
    "keyup",
    (event) => {
      if (event.key.toLowerCase() === "d") releaseInput(HOLD_GRIP);
    },
    true,
  );
}
