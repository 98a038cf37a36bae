/** The table of faults, as the server reports it: the page has no texts of its own for them. */
import { signal } from "@preact/signals";
import { readFaults } from "../api/client";
import type { FaultKind } from "../api/types";

const RETRY_MS = 2000;

export const faultKinds = signal<readonly FaultKind[]>([]);

/** The label of a fault; its code with blanks before the table is read, and of an unknown fault. */
export const labelFault = (code: string): string =>
  faultKinds.value.find((kind) => kind.code === code)?.label ?? code.replaceAll("_", " ");

/** The same within a sentence or a cell: no capital at its beginning. */
export const writeFault = (code: string): string => labelFault(code).toLowerCase();

/** Read the table when the page opens, once: it changes with the server only. */
export async function openFaults(): Promise<void> {
  try {
    faultKinds.value = await readFaults();
  } catch {
    setTimeout(() => void openFaults(), RETRY_MS);
  }
}
