/** The audit log on the instructor's page: query and answer. */
import { signal } from "@preact/signals";
import { type AuditLine, type AuditPage, type AuditQuery, readAudit } from "../../core/api/access";
import { describeError } from "../../core/state/actions";
import { t } from "../../core/text/t";

const PAGE_SIZE = 50;
const NEWEST: AuditQuery = { person: "", kind: "", onlyRefused: false, page: 1, until: "" };

export const auditQuery = signal<AuditQuery>(NEWEST);
export const auditPage = signal<AuditPage | null>(null);
export const problem = signal("");
export const isReading = signal(false);

let queryNumber = 0;

/** Run the current query; among late answers only that of the latest query counts. */
async function read(): Promise<void> {
  const number = ++queryNumber;
  isReading.value = true;
  try {
    const page = await readAudit(auditQuery.peek());
    if (number !== queryNumber) return;
    auditPage.value = page;
    problem.value = "";
  } catch (error) {
    if (number === queryNumber) problem.value = describeError(error);
  }
  if (number === queryNumber) isReading.value = false;
}

/** Start at the newest line: for these users and kinds, or as before. */
export function queryAudit(
  change: Partial<Pick<AuditQuery, "person" | "kind" | "onlyRefused">> = {},
) {
  auditQuery.value = { ...auditQuery.peek(), ...change, page: 1, until: "" };
  return read();
}

/** Another page of the same snapshot as the first one. */
export function goToPage(page: number): Promise<void> {
  auditQuery.value = { ...auditQuery.peek(), page, until: auditPage.peek()?.until ?? "" };
  return read();
}

export const countPages = (total: number): number => Math.max(1, Math.ceil(total / PAGE_SIZE));

/** Text of a kind; the server's name if the page has no text for it. */
export const nameKind = (kind: string): string =>
  t(`classroom.audit.kinds.${kind}` as "classroom.audit.kinds.law", { defaultValue: kind });

/** Local time of day; with the date if it is not `now`'s. */
export function formatTime(time: string, now: Date): string {
  const at = new Date(time);
  const clock = at.toLocaleTimeString("en-GB");
  if (at.toDateString() === now.toDateString()) return clock;
  return `${at.toLocaleDateString("en-GB", { day: "numeric", month: "short" })} ${clock}`;
}

/** The result: done, rejected with a status, or the reason of an automatic action. */
export function describeResult({ refused, status, why }: AuditLine): string {
  const end = refused
    ? status === null
      ? t("classroom.audit.refused")
      : t("classroom.audit.refusedWith", { status })
    : status === null
      ? ""
      : t("classroom.audit.done");
  return [end, why].filter((part) => part).join(": ");
}
