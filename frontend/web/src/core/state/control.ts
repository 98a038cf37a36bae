/** The access of this page to the lab, and who is in control of the session. */
import { computed, signal } from "@preact/signals";
import { type Access, readAccess } from "../api/access";
import { giveControlBack, handControlOver, lockControl, takeControl } from "../api/client";
import { perform } from "./actions";
import { nameForControl, personName, rememberPerson } from "./preferences";
import { isLive, session } from "./session";

/** Null before the lab has reported it. */
export const access = signal<Access | null>(null);

/** Number of logins on this page, by a secret, a code or a token. */
export const comings = signal(0);

export const isClass = computed(() => access.value?.authentication === "class");
export const isInstructor = computed(() => isClass.value && access.value?.role === "instructor");
export const isObserver = computed(() => isClass.value && access.value?.role === "observer");

/** Asks the lab; without an answer the previous one stays. */
export async function learnAccess(): Promise<void> {
  try {
    access.value = await readAccess();
  } catch {
    // The stream says that the lab does not answer.
  }
}

// Who is in control of the session: every user, this page, or another client.

/** Also the control that shows why it was refused. */
export const CONTROL_OF_SESSION = "control";

export const control = computed(() => session.value?.control ?? null);

/** The holder's name if another client is in control. */
export const otherHolder = computed(() =>
  control.value === null || control.value.mine ? null : control.value.holder,
);

/** Who waits for control, in a class; null elsewhere. */
export const queue = computed(() => session.value?.queue ?? null);

/** No other client is in control; in a class the user must be the holder, or the instructor. */
export const hasControl = computed(() => {
  if (isObserver.value) return false;
  if (queue.value === null || isInstructor.value) return otherHolder.value === null;
  return control.value?.mine === true;
});

/** Whether the server accepts commands of this page: connected, and no other client in control. */
export const mayCommand = computed(() => isLive.value && hasControl.value);

/** Whether the session takes a command: the loop of a bench answers to none before it ticks. */
export const takesCommands = computed(() => {
  const bench = session.value?.bench ?? null;
  return mayCommand.value && (bench === null || bench.loop.state === "ticking");
});

/** Whether the user is being asked before control is taken: for a name, or for a taking over. */
export const isAsked = signal(false);

/** Takes control at once where that needs no question. */
export function wishControl(): void {
  if (queue.peek() !== null) void askForControl();
  else if (personName.peek().trim() === "" || otherHolder.peek() !== null) isAsked.value = true;
  else void confirmControl(personName.peek());
}

export async function confirmControl(name: string): Promise<void> {
  const by = nameForControl(name);
  const isTaken = await perform(CONTROL_OF_SESSION, () =>
    takeControl(by, otherHolder.peek() !== null),
  );
  if (!isTaken) return;
  isAsked.value = false;
  rememberPerson(by);
}

/** In a class one is known, and waits for one's turn; the instructor has it at once. */
const askForControl = (): Promise<boolean> =>
  perform(CONTROL_OF_SESSION, () =>
    takeControl(nameForControl(access.peek()?.name ?? ""), isInstructor.peek()),
  );

export const handOver = (to: string): Promise<boolean> =>
  perform(CONTROL_OF_SESSION, () => handControlOver(to));

export const lock = (isLocked: boolean): Promise<boolean> =>
  perform(CONTROL_OF_SESSION, () => lockControl(isLocked));

export const leaveControl = (): Promise<boolean> => perform(CONTROL_OF_SESSION, giveControlBack);
