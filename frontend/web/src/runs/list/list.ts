/** The list of runs as the server gives it for a search, filters, an order and a page. */
import { batch, computed, effect, signal } from "@preact/signals";
import { changeRun, deleteRun, listRuns, restoreRun } from "../../core/api/runs";
import type { RunList, RunPatch, RunSummary } from "../../core/api/types";
import { reading } from "../../core/jobs/poll";
import { showErrorIn } from "../../core/state/actions";
import { attempt, runsProblem } from "./problem";

export const PAGE_SIZE = 20;
export const MAX_CHOSEN = 6;

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
export const found = signal<RunList | null>(null);
/** Runs to be laid over one another, in the order in which they were chosen. */
export const chosen = signal<readonly string[]>([]);
/** The run that was deleted last, as long as it may be taken back at once. */
export const deleted = signal<RunSummary | null>(null);

const read = reading(showErrorIn(runsProblem));

export async function refresh(): Promise<void> {
  runsProblem.value = "";
  const wanted = {
    search: search.peek().trim(),
    filters: filters.peek(),
    sort: sort.peek(),
    page: pageNumber.peek(),
    pageSize: PAGE_SIZE,
    isTrash: isTrash.peek(),
  };
  await read(
    () => listRuns(wanted),
    (answer) => {
      if (answer.runs.length === 0 && wanted.page > 1) {
        pageNumber.value = Math.max(1, Math.ceil(answer.total / PAGE_SIZE));
        return;
      }
      found.value = answer;
    },
  );
}

/** Asks again whenever what is asked for changes; returns the function that ends it. */
export const followList = (): (() => void) =>
  effect(() => {
    void [search.value, filters.value, sort.value, pageNumber.value, isTrash.value];
    void refresh();
  });

interface Asked {
  search?: string;
  filters?: Partial<Record<Filter, string>>;
  sort?: string;
  isTrash?: boolean;
}

/** Another search, filter, order or trash begins on its first page. */
export function ask(change: Asked): void {
  batch(() => {
    pageNumber.value = 1;
    if (change.search !== undefined) search.value = change.search;
    if (change.filters !== undefined) filters.value = { ...filters.peek(), ...change.filters };
    if (change.sort !== undefined) sort.value = change.sort;
    if (change.isTrash !== undefined) isTrash.value = change.isTrash;
  });
}

/** Whether something keeps runs off the list. */
export const isNarrowed = computed(
  () => search.value.trim() !== "" || FILTERS.some((filter) => filters.value[filter] !== ""),
);

export const showAll = (): void => ask({ search: "", filters: UNFILTERED });

export function toggleChosen(run: string): void {
  const before = chosen.peek();
  chosen.value = before.includes(run) ? before.filter((id) => id !== run) : [...before, run];
}

/** Takes over a run that the server has changed. */
function accept(run: RunSummary): void {
  const list = found.peek();
  if (list === null) return;
  found.value = { ...list, runs: list.runs.map((row) => (row.id === run.id ? run : row)) };
}

/** Null where it was refused; the list has then what the run says now. */
export async function patchRun(run: RunSummary, patch: RunPatch): Promise<RunSummary | null> {
  const answer = await attempt(() => changeRun(run, patch));
  if (answer) accept(answer);
  if (answer === null || patch.tags) void refresh();
  return answer;
}

export async function putIntoTrash(run: string): Promise<boolean> {
  const answer = await attempt(() => deleteRun(run));
  if (answer === null) return false;
  deleted.value = answer;
  chosen.value = chosen.peek().filter((id) => id !== run);
  await refresh();
  return true;
}

export async function takeBack(run: string): Promise<void> {
  if ((await attempt(() => restoreRun(run))) === null) return;
  if (deleted.peek()?.id === run) deleted.value = null;
  await refresh();
}
