/** The audit log on the instructor's page: what is asked of it, and what came. */
import { signal } from "@preact/signals";
import { type AuditLine, type AuditPage, type AuditWish, readAudit } from "../../core/api/access";
import { describeError } from "../../core/state/actions";
import { text } from "../../core/text/en";

const words = text.classroom.audit;
const PAGE_SIZE = 50;
const NEWEST: AuditWish = { person: "", kind: "", onlyRefused: false, page: 1, until: "" };

export const wish = signal<AuditWish>(NEWEST);
export const auditPage = signal<AuditPage | null>(null);
export const problem = signal("");
export const isReading = signal(false);

let asked = 0;

/** Reads what is asked for now; of answers that come late the last one asked for counts. */
async function read(): Promise<void> {
  const number = ++asked;
  isReading.value = true;
  try {
    const page = await readAudit(wish.peek());
    if (number !== asked) return;
    auditPage.value = page;
    problem.value = "";
  } catch (error) {
    if (number === asked) problem.value = describeError(error);
  }
  if (number === asked) isReading.value = false;
}

/** From the newest line on: of these people and kinds, or as before. */
export function askFor(change: Partial<Pick<AuditWish, "person" | "kind" | "onlyRefused">> = {}) {
  wish.value = { ...wish.peek(), ...change, page: 1, until: "" };
  return read();
}

/** Another page of the same, as it was when the first one was read. */
export function turnTo(page: number): Promise<void> {
  wish.value = { ...wish.peek(), page, until: auditPage.peek()?.until ?? "" };
  return read();
}

export const countPages = (total: number): number => Math.max(1, Math.ceil(total / PAGE_SIZE));

/** A kind in words; one that the page has no word for as the server calls it. */
export const nameKind = (kind: string): string =>
  Object.hasOwn(words.kinds, kind) ? words.kinds[kind as keyof typeof words.kinds] : kind;

/** The time of day here; with its date where that is not `now`'s. */
export function formatTime(time: string, now: Date): string {
  const at = new Date(time);
  const clock = at.toLocaleTimeString("en-GB");
  if (at.toDateString() === now.toDateString()) return clock;
  return `${at.toLocaleDateString("en-GB", { day: "numeric", month: "short" })} ${clock}`;
}

/** The result: done, rejected with a status, or the reason of an automatic action. */
export function describeEnd({ refused, status, why }: AuditLine): string {
  const end = refused ? words.refused(status) : status === null ? "" : words.done;
  return [end, why].filter((part) => part).join(": ");
}
