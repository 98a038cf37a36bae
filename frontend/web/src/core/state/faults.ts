/** The faults among the kinds of the server: the page has no texts of its own for them. */
import { kinds } from "./kinds";

/** Label of a fault; for an unknown fault, or before the kinds are read, its code in the API. */
export const labelFault = (code: string): string =>
  kinds.value?.faults.find((kind) => kind.code === code)?.label ?? code;

/** The label within a sentence or a cell, in lower case. */
export const writeFault = (code: string): string => labelFault(code).toLowerCase();
