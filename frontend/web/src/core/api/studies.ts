/** Studies and their jobs, one function per call. */
import { LockedError, RefusedError, UnansweredError } from "./errors";
import { call } from "./operations";
import { API, client, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";
import type { Refusal } from "./types";

type Schemas = components["schemas"];

export type Study = Schemas["StudyState"];
export type StudyPlan = Schemas["StudyPlan"];
export type StudyColumn = Schemas["StudyColumn"];
export type StudyList = Schemas["StudyList"];
export type StudySummary = Schemas["StudySummary"];
export type Estimate = Schemas["Estimate"];
export type SobolIndices = Schemas["SobolIndices"];
export type StudyRow = Readonly<Record<string, string | number | boolean | null>>;

const CLIENT_HEADER = "SVSA-Client";
const pathOf = (study: string, rest = ""): string => `studies/${encodeURIComponent(study)}${rest}`;

export const listStudies = () => call("get", "/studies", {});
export const readStudy = (study: string) => call("get", "/studies/{study}", { path: { study } });
export const checkStudy = (body: object) => call("post", "/studies/check", { body: body as never });
export const startStudy = (body: object) =>
  call("post", "/studies", { body: body as never }, WORK_TIMEOUT_MS);
/**
 * Delete permanently; a running study is cancelled first, which may take as long as its current
 * rows.
 */
export const deleteStudy = (study: string) =>
  call("delete", "/studies/{study}", { path: { study } }, WORK_TIMEOUT_MS);
export const readSummary = (study: string) =>
  call("get", "/studies/{study}/summary", { path: { study } }, WORK_TIMEOUT_MS);
export const readSensitivity = (study: string, outcome: string) =>
  call(
    "get",
    "/studies/{study}/sensitivity",
    { path: { study }, query: { outcome } },
    WORK_TIMEOUT_MS,
  );
export const readRow = (study: string, row: number) =>
  call("get", "/studies/{study}/rows/{row}", { path: { study, row } }) as Promise<StudyRow>;
/** Record one row as a run. */
export const replayRow = (study: string, row: number) =>
  call("post", "/studies/{study}/rows/{row}/replay", { path: { study, row } }, WORK_TIMEOUT_MS);
export const tableOf = (study: string): string =>
  new URL(pathOf(study, "/rows?format=parquet"), API).href;

/** Shares with 95 % confidence intervals; counts: pairs (successes, total), at most 256. */
export const estimateShares = (counts: readonly (readonly [number, number])[]) =>
  call("get", "/shares", {
    query: { counts: counts.map(([count, total]) => `${count},${total - count}`) },
  });

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
