/** Whether the panel of the class is open, and how often it is read anew then. */
import { signal } from "@preact/signals";

export const isOpen = signal(false);
export const READ_MS = 2000;
