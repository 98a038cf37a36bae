/** The public REST API of the recorded runs, one function a call. */
import { API, request, sessionName } from "./request";
import type {
  ExportName,
  RunDetails,
  RunDifference,
  RunList,
  RunOrigin,
  RunPatch,
  RunSamples,
  RunSummary,
  SessionState,
} from "./types";

const LONG_WAIT_MS = 60_000;

export interface RunsWanted {
  search: string;
  /** Only runs that have these: facet and value, "" for any. */
  filters: Readonly<Record<string, string>>;
  sort: string;
  page: number;
  pageSize: number;
  isTrash: boolean;
}

const pathOf = (run: string, rest = ""): string => `runs/${encodeURIComponent(run)}${rest}`;

export function listRuns(wanted: RunsWanted): Promise<RunList> {
  const { search, filters, sort, page, pageSize, isTrash } = wanted;
  const query = new URLSearchParams({ sort, page: String(page), page_size: String(pageSize) });
  if (search) query.set("search", search);
  for (const [facet, value] of Object.entries(filters)) if (value) query.set(facet, value);
  if (isTrash) query.set("trash", "true");
  return request("get", `runs?${query}`) as Promise<RunList>;
}

export const readRun = (run: string) => request("get", pathOf(run)) as Promise<RunDetails>;
/** Refused with 412 where somebody else has changed the run since this was read of it. */
export const changeRun = (run: Pick<RunSummary, "id" | "revision">, patch: RunPatch) =>
  request("patch", pathOf(run.id), patch, undefined, {
    "If-Match": `"${run.revision}"`,
  }) as Promise<RunSummary>;
export const deleteRun = (run: string) => request("delete", pathOf(run)) as Promise<RunSummary>;
export const restoreRun = (run: string) =>
  request("post", pathOf(run, "/restore")) as Promise<RunSummary>;
export const readRunOrigin = (run: string) =>
  request("get", pathOf(run, "/origin"), undefined, LONG_WAIT_MS) as Promise<RunOrigin>;
export function readDifference(run: string, others: readonly string[]): Promise<RunDifference> {
  const query = new URLSearchParams(others.map((other) => ["other", other]));
  return request("get", pathOf(run, `/difference?${query}`)) as Promise<RunDifference>;
}

export const branchRun = (run: string, tick: number) =>
  request("post", pathOf(run, "/branch"), { tick }, LONG_WAIT_MS) as Promise<SessionState>;

export function readSamples(
  run: string,
  channels: readonly string[],
  points: number,
): Promise<RunSamples> {
  const query = new URLSearchParams({ channels: channels.join(","), points: String(points) });
  return request("get", pathOf(run, `/samples?${query}`)) as Promise<RunSamples>;
}

/** The run that the page's session is on. */
export const readOrigin = () =>
  request(
    "get",
    `sessions/${encodeURIComponent(sessionName)}/origin`,
    undefined,
    LONG_WAIT_MS,
  ) as Promise<RunOrigin>;

export const exportPath = (run: string, kind: ExportName | "html"): string =>
  pathOf(run, kind === "html" ? "/replay.html" : `/export?kind=${kind}`);
export const addressOf = (path: string): string => String(new URL(path, API));
export const replayAddress = (run: string, timeS: number): string =>
  addressOf(pathOf(run, timeS > 0 ? `/replay?t=${timeS}` : "/replay"));
