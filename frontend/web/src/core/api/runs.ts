/** The public REST API of the recorded runs, one function per call. */
import { call, Edit } from "./operations";
import { API, readRefusal, WORK_TIMEOUT_MS } from "./request";
import type { ExportName, RunList, RunPatch, RunSummary, VerdictRequest } from "./types";

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
  const chosen = Object.entries({ search, ...filters }).filter(([, value]) => value);
  const query = { sort, page, page_size: pageSize, trash: isTrash, ...Object.fromEntries(chosen) };
  return call("get", "/runs", { query: query as never });
}

export const readRun = (run: string) => call("get", "/runs/{run_id}", { path: { run_id: run } });
/** Rejected with 412 if another client has changed the run since this revision was read. */
export const changeRun = (
  { id, revision }: Pick<RunSummary, "id" | "revision">,
  body: Partial<RunPatch>,
) => {
  const edit = new Edit(null, { revision });
  return call("patch", "/runs/{run_id}", { path: { run_id: id }, body, edit });
};
export const deleteRun = (run: string) =>
  call("delete", "/runs/{run_id}", { path: { run_id: run } });
export const restoreRun = (run: string) =>
  call("patch", "/runs/{run_id}", {
    path: { run_id: run },
    body: { deleted: false },
    edit: null,
  });
export const readRunOrigin = (run: string) =>
  call("get", "/runs/{run_id}/origin", { path: { run_id: run } }, WORK_TIMEOUT_MS);
export const readDifference = (run: string, others: readonly string[]) =>
  call("get", "/runs/{run_id}/difference", {
    path: { run_id: run },
    query: { other: others },
  });

export const assessRun = (run: string, body: VerdictRequest) =>
  call("post", "/runs/{run_id}/verdict", { path: { run_id: run }, body }, WORK_TIMEOUT_MS);

export const branchRun = (run: string, tick: number) =>
  call("post", "/sessions", { body: { from: "run", id: run, tick } }, WORK_TIMEOUT_MS);

export const readSamples = (run: string, channels: readonly string[], points: number) =>
  call("get", "/runs/{run_id}/samples", {
    path: { run_id: run },
    query: { channels: channels.join(","), points },
  });

/** The run from which the page's session started. */
export const readOrigin = () => call("get", "/sessions/{session}/origin", {}, WORK_TIMEOUT_MS);

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
