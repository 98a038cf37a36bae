/** Access of this page to the lab: authentication, role, logins. */
import { computed, signal } from "@preact/signals";
import { type Access, readAccess } from "../api/access";
import { parametersOf, type Template } from "../api/operations";
import type { Method } from "../api/types";

/** Null until the lab has reported it. */
export const access = signal<Access | null>(null);

/** Number of logins on this page, by a secret, a code or a token. */
export const loginCount = signal(0);

export const isClass = computed(() => access.value?.authentication === "class");
export const isInstructor = computed(() => isClass.value && access.value?.role === "instructor");
const ROLES = ["public", "observer", "operator", "instructor"];
/** Whether the role of the user in a class permits an operation. */
export const mayCall = <M extends Method>(method: M, template: Template<M>): boolean =>
  !isClass.value ||
  ROLES.indexOf(access.value?.role ?? "public") >=
    ROLES.indexOf(parametersOf(method, template).permission ?? "");

export const isObserver = computed(() => isClass.value && access.value?.role === "observer");

/** Query the lab; without an answer the previous value stays. */
export async function updateAccess(): Promise<void> {
  try {
    access.value = await readAccess();
  } catch {
    // The stream reports that the lab does not answer.
  }
}
