/** Who is in control of the session: everybody, this page, or somebody else. */
import { computed, signal } from "@preact/signals";
import { giveControlBack, takeControl } from "../api/client";
import { perform } from "./actions";
import { nameForControl, personName, rememberPerson } from "./preferences";
import { isLive, session } from "./session";

/** Also the control that shows why it was refused. */
export const CONTROL_OF_SESSION = "control";

export const control = computed(() => session.value?.control ?? null);

/** Their name, where somebody else is in control. */
export const otherHolder = computed(() =>
  control.value === null || control.value.mine ? null : control.value.holder,
);

/** Whether what this page sends is taken: it is connected, and nobody else is in control. */
export const mayCommand = computed(() => isLive.value && otherHolder.value === null);

/** Whether the session takes a command: the loop of a bench answers to none before it ticks. */
export const takesCommands = computed(() => {
  const bench = session.value?.bench ?? null;
  return mayCommand.value && (bench === null || bench.loop.state === "ticking");
});

/** Whether the user is being asked before control is taken: for a name, or for a taking over. */
export const isAsked = signal(false);

/** Takes control at once where that needs no question. */
export function wishControl(): void {
  if (personName.peek().trim() === "" || otherHolder.peek() !== null) isAsked.value = true;
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

export const leaveControl = (): Promise<boolean> => perform(CONTROL_OF_SESSION, giveControlBack);
