/** The control lease of the session. */
import { computed, signal } from "@preact/signals";
import {
  deleteControl,
  handControlOver,
  lockControl,
  openPrivateSession,
  takeControl,
} from "../api/client";
import { access, isInstructor, isObserver } from "./access";
import { explain, perform, problem } from "./actions";
import { nameForControl, personName, setPersonName } from "./preferences";
import { isLive, session } from "./session";

/** Name of the control that shows why it was rejected. */
export const CONTROL_OF_SESSION = "control";

export const control = computed(() => session.value?.control ?? null);

/** The holder's name if another client is in control. */
export const otherHolder = computed(() =>
  control.value === null || control.value.mine ? null : control.value.holder,
);

/** The queue for control in a class; null otherwise. */
export const queue = computed(() => session.value?.queue ?? null);

/** No other client is in control; in a class the user must be the holder or the instructor. */
export const hasControl = computed(() => {
  if (isObserver.value) return false;
  if (queue.value === null || isInstructor.value) return otherHolder.value === null;
  return control.value?.mine === true;
});

/** Whether the server accepts commands of this page: connected, and no other client in control. */
export const mayCommand = computed(() => isLive.value && hasControl.value);

/** Whether the session accepts commands: the loop of a bench accepts none before its first tick. */
export const takesCommands = computed(() => {
  const bench = session.value?.bench ?? null;
  return mayCommand.value && (bench === null || bench.loop.state === "ticking");
});

/** Whether a dialog is open before control is taken: for a name, or to confirm taking over. */
export const isControlDialogOpen = signal(false);

/** Take control at once if no dialog is necessary. */
export function requestControl(): void {
  if (queue.peek() !== null) void joinControlQueue();
  else if (personName.peek().trim() === "" || otherHolder.peek() !== null)
    isControlDialogOpen.value = true;
  else void confirmControl(personName.peek());
}

export async function confirmControl(name: string): Promise<void> {
  const clientName = nameForControl(name);
  const isTaken = await perform(
    CONTROL_OF_SESSION,
    takeControl(clientName, otherHolder.peek() !== null),
  );
  if (!isTaken) return;
  isControlDialogOpen.value = false;
  setPersonName(clientName);
}

/** In a class the user's name is known: join the queue; the instructor gets control at once. */
const joinControlQueue = (): Promise<boolean> =>
  perform(
    CONTROL_OF_SESSION,
    takeControl(nameForControl(access.peek()?.name ?? ""), isInstructor.peek()),
  );

export const handOver = (to: string): Promise<boolean> =>
  perform(CONTROL_OF_SESSION, handControlOver(to));

export const lock = (isLocked: boolean): Promise<boolean> =>
  perform(CONTROL_OF_SESSION, lockControl(isLocked));

/** Continues in a session that no other user commands; the page is reloaded with it. */
export async function openOwnSession(arm = ""): Promise<void> {
  problem.value = null;
  try {
    const search = new URLSearchParams(location.search);
    search.set("session", await openPrivateSession(arm));
    location.search = String(search);
  } catch (error) {
    problem.value = { control: CONTROL_OF_SESSION, message: explain(error) };
  }
}

export const releaseControl = (): Promise<boolean> => perform(CONTROL_OF_SESSION, deleteControl);
