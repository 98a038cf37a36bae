/** The table of faults from the server: the page has no texts of its own for them. */
import { signal } from "@preact/signals";
import { readFaults } from "../api/client";
import type { FaultKind } from "../api/types";

const RETRY_MS = 2000;

export const faultKinds = signal<readonly FaultKind[]>([]);

/** Label of a fault; for an unknown fault, or before the table is read, its code with spaces. */
export const labelFault = (code: string): string =>
  faultKinds.value.find((kind) => kind.code === code)?.label ?? code.replaceAll("_", " ");

/** The label within a sentence or a cell, in lower case. */
export const writeFault = (code: string): string => labelFault(code).toLowerCase();

/** Read the table once, when the page opens: it changes only with the server. */
export async function openFaults(): Promise<void> {
  try {
    faultKinds.value = await readFaults();
  } catch {
    setTimeout(() => void openFaults(), RETRY_MS);
  }
}
