/** Studies and their jobs, one function per call. */
import { LockedError, RefusedError, UnansweredError } from "./errors";
import { API, client, request, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";
import type { Law, Refusal } from "./types";

type Schemas = components["schemas"];

export type Study = Schemas["StudyState"];
export type StudyPlan = Schemas["StudyPlan"];
export type StudyColumn = Schemas["StudyColumn"];
export type StudyList = Schemas["StudyList"];
export type StudySummary = Schemas["StudySummary"];
export type Estimate = Schemas["Estimate"];
export type SobolIndices = Schemas["SobolIndices"];
type RowReplay = Schemas["RowReplay"];
export type StudyRow = Readonly<Record<string, string | number | boolean | null>>;

/** Requested changes; fields that are left out keep the value of the source or the text. */
export interface StudyChanges {
  source?: string;
  text?: string;
  name?: string;
  runs?: number;
  laws?: readonly Law[];
  metrics?: readonly string[];
  success?: Readonly<Record<string, number>>;
}

const CLIENT_HEADER = "SVSA-Client";
const pathOf = (study: string, rest = ""): string => `studies/${encodeURIComponent(study)}${rest}`;

export const listStudies = () => request("get", "studies") as Promise<StudyList>;
export const readStudy = (study: string) => request("get", pathOf(study)) as Promise<Study>;
export const checkStudy = (changes: StudyChanges) =>
  request("post", "studies/check", changes) as Promise<StudyPlan>;
export const startStudy = (changes: StudyChanges) =>
  request("post", "studies", changes, WORK_TIMEOUT_MS) as Promise<Study>;
/**
 * Delete permanently; a running study is cancelled first, which may take as long as its current
 * rows.
 */
export const deleteStudy = (study: string) =>
  request("delete", pathOf(study), undefined, WORK_TIMEOUT_MS);
export const readSummary = (study: string) =>
  request("get", pathOf(study, "/summary"), undefined, WORK_TIMEOUT_MS) as Promise<StudySummary>;
export const readSensitivity = (study: string, outcome: string) =>
  request(
    "get",
    pathOf(study, `/sensitivity?outcome=${encodeURIComponent(outcome)}`),
    undefined,
    WORK_TIMEOUT_MS,
  ) as Promise<SobolIndices[]>;
export const readRow = (study: string, row: number) =>
  request("get", pathOf(study, `/rows/${row}`)) as Promise<StudyRow>;
/** Record one row as a run. */
export const replayRow = (study: string, row: number) =>
  request(
    "post",
    pathOf(study, `/rows/${row}/replay`),
    undefined,
    WORK_TIMEOUT_MS,
  ) as Promise<RowReplay>;
export const tableOf = (study: string): string =>
  new URL(pathOf(study, "/rows?format=parquet"), API).href;

/** Shares with 95 % confidence intervals; counts: pairs (successes, total), at most 256. */
export const estimateShares = (counts: readonly (readonly [number, number])[]) => {
  const pairs = counts.map(([count, total]) => `counts=${count},${total - count}`);
  return request("get", `shares?${pairs.join("&")}`) as Promise<Estimate[]>;
};

/** Columns of all rows, or of a random subset of them, as the server packs them. */
export async function readRows(study: string, columns: readonly string[]): Promise<ArrayBuffer> {
  const query = new URLSearchParams(columns.map((column) => ["column", column]));
  let response: Response;
  try {
    response = await fetch(new URL(pathOf(study, `/rows?${query}`), API), {
      cache: "no-store",
      headers: { [CLIENT_HEADER]: client },
      signal: AbortSignal.timeout(WORK_TIMEOUT_MS),
    });
    if (response.ok) return await response.arrayBuffer();
  } catch (cause) {
    throw new UnansweredError(cause);
  }
  const refusal = (await response.json().catch(() => null)) as Partial<Refusal> | null;
  const message = refusal?.detail ?? `${response.status} ${response.statusText}`;
  if (response.status === 401) throw new LockedError(message);
  throw new RefusedError(response.status, message, refusal?.violations ?? []);
}
