/** As whom this page has come into the lab. */
import { computed, signal } from "@preact/signals";
import { type Access, readAccess } from "../api/access";

/** Null before the lab has told it. */
export const access = signal<Access | null>(null);

/** How often somebody has come in here, by a secret, a code or a token. */
export const comings = signal(0);

export const isClass = computed(() => access.value?.door === "class");
export const isInstructor = computed(() => isClass.value && access.value?.role === "instructor");
export const isObserver = computed(() => isClass.value && access.value?.role === "observer");

/** Asks the lab; what it told before stays where it does not answer. */
export async function learnAccess(): Promise<void> {
  try {
    access.value = await readAccess();
  } catch {
    // The stream says that the lab does not answer.
  }
}
