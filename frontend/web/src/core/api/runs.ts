/** The public REST API of the recorded runs, one function per call. */
import { API, readRefusal, request, sessionName, WORK_TIMEOUT_MS } from "./request";
import type {
  ExportName,
  RunDetails,
  RunDifference,
  RunList,
  RunOrigin,
  RunPatch,
  RunSamples,
  RunSummary,
  RunVerdict,
  SessionState,
  VerdictRequest,
} from "./types";

interface RunQuery {
  search: string;
  /** Only runs with these values by facet; "" for any value. */
  filters: Readonly<Record<string, string>>;
  sort: string;
  page: number;
  pageSize: number;
  isTrash: boolean;
}

const pathOf = (run: string, rest = ""): string => `runs/${encodeURIComponent(run)}${rest}`;

export function listRuns(runQuery: RunQuery): Promise<RunList> {
  const { search, filters, sort, page, pageSize, isTrash } = runQuery;
  const query = new URLSearchParams({ sort, page: String(page), page_size: String(pageSize) });
  if (search) query.set("search", search);
  for (const [facet, value] of Object.entries(filters)) if (value) query.set(facet, value);
  if (isTrash) query.set("trash", "true");
  return request("get", `runs?${query}`) as Promise<RunList>;
}

export const readRun = (run: string) => request("get", pathOf(run)) as Promise<RunDetails>;
/** Rejected with 412 if another client has changed the run since this revision was read. */
export const changeRun = (run: Pick<RunSummary, "id" | "revision">, patch: RunPatch) =>
  request("patch", pathOf(run.id), patch, undefined, {
    "If-Match": `"${run.revision}"`,
  }) as Promise<RunSummary>;
export const deleteRun = (run: string) => request("delete", pathOf(run)) as Promise<RunSummary>;
export const restoreRun = (run: string) =>
  request("patch", pathOf(run), { deleted: false }) as Promise<RunSummary>;
export const readRunOrigin = (run: string) =>
  request("get", pathOf(run, "/origin"), undefined, WORK_TIMEOUT_MS) as Promise<RunOrigin>;
export function readDifference(run: string, others: readonly string[]): Promise<RunDifference> {
  const query = new URLSearchParams(others.map((other) => ["other", other]));
  return request("get", pathOf(run, `/difference?${query}`)) as Promise<RunDifference>;
}

export const assessRun = (run: string, runQuery: VerdictRequest) =>
  request("post", pathOf(run, "/verdict"), runQuery, WORK_TIMEOUT_MS) as Promise<RunVerdict>;

export const branchRun = (run: string, tick: number) =>
  request(
    "post",
    "sessions",
    { from: "run", id: run, tick },
    WORK_TIMEOUT_MS,
  ) as Promise<SessionState>;

export function readSamples(
  run: string,
  channels: readonly string[],
  points: number,
): Promise<RunSamples> {
  const query = new URLSearchParams({ channels: channels.join(","), points: String(points) });
  return request("get", pathOf(run, `/samples?${query}`)) as Promise<RunSamples>;
}

/** The run from which the page's session started. */
export const readOrigin = () =>
  request(
    "get",
    `sessions/${encodeURIComponent(sessionName)}/origin`,
    undefined,
    WORK_TIMEOUT_MS,
  ) as Promise<RunOrigin>;

export const exportPath = (run: string, kind: ExportName): string =>
  pathOf(run, `/export?kind=${kind}`);
/** Size and content of an export; exports that take minutes are made on request. */
export async function fetchFile(path: string): Promise<{ name: string; content: Blob }> {
  const answer = await fetch(addressOf(path), { signal: AbortSignal.timeout(WORK_TIMEOUT_MS) });
  if (!answer.ok) throw await readRefusal(answer);
  const named = answer.headers.get("Content-Disposition") ?? "";
  const name = /filename="?([^";]+)"?/.exec(named)?.[1] ?? "replay.html";
  return { name, content: await answer.blob() };
}
export const addressOf = (path: string): string => String(new URL(path, API));
export const replayAddress = (run: string): string => addressOf(pathOf(run, "/replay"));
/** Initial position of a replay, s after its first sample. */
export const atMoment = (replay: string, timeS: number): string =>
  timeS > 0 ? `${replay}?t=${timeS}` : replay;
