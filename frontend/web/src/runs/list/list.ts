/** The list of runs from the server for a search, filters, an order and a page. */
import { batch, computed, effect, signal } from "@preact/signals";
import { changeRun, deleteRun, listRuns, restoreRun } from "../../core/api/runs";
import type { RunList, RunPatch, RunSummary } from "../../core/api/types";
import { createReader } from "../../core/jobs/poll";
import { showErrorIn } from "../../core/state/actions";
import { isEqual } from "../../core/state/changes";
import { attempt, runsProblem } from "./problem";

export const PAGE_SIZE = 20;
export const MAX_SELECTED = 6;

export const FILTERS = ["law", "load", "figure", "plant", "tag"] as const;
export type Filter = (typeof FILTERS)[number];
const UNFILTERED: Readonly<Record<Filter, string>> = {
  law: "",
  load: "",
  figure: "",
  plant: "",
  tag: "",
};
const NEWEST_FIRST = "-created";

export const search = signal("");
export const filters = signal(UNFILTERED);
export const sort = signal(NEWEST_FIRST);
export const pageNumber = signal(1);
export const isTrash = signal(false);
export const runList = signal<RunList | null>(null);
/** Runs of an overlay, in the order in which they were selected. */
export const selectedRuns = signal<readonly string[]>([]);
/** The run that was deleted last, while the deletion can be undone. */
export const deleted = signal<RunSummary | null>(null);

const read = createReader(showErrorIn(runsProblem));

export async function refresh(): Promise<void> {
  runsProblem.value = "";
  await readList();
}

async function readList(): Promise<void> {
  const query = {
    search: search.peek().trim(),
    filters: filters.peek(),
    sort: sort.peek(),
    page: pageNumber.peek(),
    pageSize: PAGE_SIZE,
    isTrash: isTrash.peek(),
  };
  await read(
    () => listRuns(query),
    (answer) => {
      if (answer.runs.length === 0 && query.page > 1) {
        pageNumber.value = Math.max(1, Math.ceil(answer.total / PAGE_SIZE));
        return;
      }
      runList.value = answer;
    },
  );
}

/** Request again whenever the query changes; returns the function that stops it. */
export const followList = (): (() => void) =>
  effect(() => {
    void [search.value, filters.value, sort.value, pageNumber.value, isTrash.value];
    void refresh();
  });

interface QueryChange {
  search?: string;
  filters?: Partial<Record<Filter, string>>;
  sort?: string;
  isTrash?: boolean;
}

/** A new search, filter, order or trash starts on its first page. */
export function changeQuery(change: QueryChange): void {
  batch(() => {
    pageNumber.value = 1;
    if (change.search !== undefined) search.value = change.search;
    if (change.filters !== undefined) filters.value = { ...filters.peek(), ...change.filters };
    if (change.sort !== undefined) sort.value = change.sort;
    if (change.isTrash !== undefined) isTrash.value = change.isTrash;
  });
}

/** Whether a filter or search is active. */
export const isFiltered = computed(
  () => search.value.trim() !== "" || FILTERS.some((filter) => filters.value[filter] !== ""),
);

export const showAll = (): void => changeQuery({ search: "", filters: UNFILTERED });

export function toggleSelected(run: string): void {
  const before = selectedRuns.peek();
  selectedRuns.value = before.includes(run) ? before.filter((id) => id !== run) : [...before, run];
}

/** Apply the server's changes of a run. */
function applyRun(run: RunSummary): void {
  const list = runList.peek();
  if (list === null) return;
  runList.value = { ...list, runs: list.runs.map((row) => (row.id === run.id ? run : row)) };
}

let lastChange: Promise<RunSummary | null> | null = null;

/** The newer of two states of a run, if the fields of the patch are equal in both. */
function chooseBase(run: RunSummary, newer: RunSummary | null, patch: RunPatch): RunSummary {
  if (newer?.id !== run.id) return run;
  const fields = Object.keys(patch) as (keyof RunPatch & keyof RunSummary)[];
  return fields.every((field) => isEqual(newer[field], run[field])) ? newer : run;
}

/**
 * Null if it was rejected; the list then has the current state of the run. A change during the
 * previous one waits for its answer, which has the revision for a change of other fields.
 */
export async function patchRun(run: RunSummary, patch: RunPatch): Promise<RunSummary | null> {
  const previousChange = lastChange;
  const change = async () => {
    const newer = await previousChange;
    return attempt(() => changeRun(chooseBase(run, newer, patch), patch));
  };
  const ownChange = change();
  lastChange = ownChange;
  const answer = await ownChange;
  if (lastChange === ownChange) lastChange = null;
  if (answer) applyRun(answer);
  // The reason of a rejection stays.
  if (answer === null || patch.tags) void readList();
  return answer;
}

export async function moveToTrash(run: string): Promise<boolean> {
  const answer = await attempt(() => deleteRun(run));
  if (answer === null) return false;
  deleted.value = answer;
  selectedRuns.value = selectedRuns.peek().filter((id) => id !== run);
  await refresh();
  return true;
}

export async function restoreFromTrash(run: string): Promise<void> {
  if ((await attempt(() => restoreRun(run))) === null) return;
  if (deleted.peek()?.id === run) deleted.value = null;
  await refresh();
}
