/** The studies of this lab, the selected one, its rows, and the selected run. */
import { computed, signal } from "@preact/signals";
import { stopJob } from "../../core/api/jobs";
import {
  deleteStudy,
  listStudies,
  readRow,
  readRows,
  readSensitivity,
  readStudy,
  readSummary,
  replayRow,
  type SobolIndices,
  type Study,
  type StudyList,
  type StudyRow,
  type StudySummary,
  startStudy,
} from "../../core/api/studies";
import { nullIfRejected } from "../../core/jobs/poll";
import { isJobRunning } from "../../core/jobs/progress";
import { createWork } from "../../core/jobs/work";
import { goTo, place, storeStudyView } from "../../runs/list/place";
import { NOTHING, type Rows, unpackRows } from "./rows";
import { chooseAxes, type PlaneBrush, readBrush, writeBrush } from "./studyview";

const GROWTH = 1.25;

export const list = signal<StudyList | null>(null);
export const study = signal<Study | null>(null);
export const rows = signal<Rows>(NOTHING);
export const summary = signal<StudySummary | null>(null);
export const indices = signal<readonly SobolIndices[]>([]);
export const selectedRows = signal<readonly StudyRow[]>([]);

const view = computed(() => (place.value.kind === "studies" ? place.value.look : {}));
/** The study that the address names, else the newest one; before the first the example. */
export const chosenName = computed(() => {
  const named = place.value.kind === "studies" ? place.value.study : "";
  return named || (list.value?.saved[0]?.name ?? "");
});
export const axes = computed((): Record<string, string> => {
  const columns = study.value?.columns ?? [];
  const known = Object.entries(view.value).filter(
    ([part, name]) => part !== "law" && columns.some((column) => column.name === name),
  );
  return { ...chooseAxes(columns), ...Object.fromEntries(known) };
});
/** The law whose runs the planes and the map show, or "" for all; by default the first. */
export const shownLaw = computed(() => {
  const laws = study.value?.laws ?? [];
  const requested = view.value.law ?? laws[0] ?? "";
  return laws.includes(requested) ? requested : "";
});
export const EVERY_LAW = "every";
export const brush = computed(() => readBrush(view.value.brush ?? ""));

export const setView = (changed: Readonly<Record<string, string>>): void =>
  storeStudyView(chosenName.peek(), { ...view.peek(), ...changed });
export const setBrush = (next: PlaneBrush | null): void =>
  setView({ brush: next === null ? "" : writeBrush(next) });

const { perform, poll, read, run, showError, ...work } = createWork();
export const { attempt, problem, isBusy, leave, stopFollowing } = work;

export const openList = () =>
  read(listStudies, (studies) => {
    list.value = studies;
  });

const columnsToRead = (names: Readonly<Record<string, string>>): string[] => [
  ...new Set(["law", "fault", "succeeded", ...Object.values(names)].filter((name) => name !== "")),
];

async function loadRows(name: string): Promise<void> {
  const packed = await readRows(name, columnsToRead(axes.peek()));
  if (chosenName.peek() === name) rows.value = unpackRows(packed);
}

export const fetchRows = (name: string) => attempt(() => loadRows(name));

async function loadSummary(shown: Study): Promise<void> {
  const answer = await nullIfRejected(readSummary(shown.name), showError);
  if (chosenName.peek() !== shown.name) return;
  summary.value = answer;
  if (shown.study.sampling !== "sensitivity") return;
  const shares = await nullIfRejected(readSensitivity(shown.name, "succeeded"), () => {});
  if (chosenName.peek() === shown.name) indices.value = shares ?? [];
}

/** Select a study, and follow it while it runs. */
export async function follow(name: string): Promise<void> {
  stopFollowing();
  study.value = null;
  rows.value = NOTHING;
  summary.value = null;
  indices.value = [];
  selectedRows.value = [];
  if (name === "") return;
  let shownCount = 0;
  await poll(
    () => readStudy(name),
    async (current, isLeft) => {
      study.value = current;
      const isEnded = !isJobRunning(current.job);
      if (current.done > 0 && (isEnded || current.done > shownCount * GROWTH)) {
        await nullIfRejected(loadRows(name), showError);
        if (isLeft()) return false;
        shownCount = current.done;
      }
      if (!isEnded) return false;
      void openList();
      if (current.done > 0) await loadSummary(current);
      return true;
    },
  );
}

/** Start and select it; throws if it is rejected. */
export async function startNewStudy(request: object): Promise<void> {
  const started = await run("start", () => startStudy(request));
  void openList();
  const isHere = chosenName.peek() === started.name;
  goTo({ kind: "studies", study: started.name, look: isHere ? view.peek() : {} });
  if (isHere) void follow(started.name);
}

export async function cancel(): Promise<void> {
  const job = study.peek()?.job;
  if (job) await attempt(() => stopJob(job.id));
}

/** Returns whether it was deleted; then no study is selected. */
export async function remove(name: string): Promise<boolean> {
  const isGone = await perform("delete", () => deleteStudy(name).then(() => true));
  if (isGone === null) return false;
  await openList();
  goTo({ kind: "studies", study: "", look: {} });
  return true;
}

/** The selected row; the previously selected one is kept for an overlay. */
export async function selectRow(row: number): Promise<void> {
  const name = chosenName.peek();
  const known = selectedRows.peek();
  if (known.at(-1)?.row === row) return;
  const selected = await attempt(() => readRow(name, row));
  if (selected !== null) {
    selectedRows.value = [...known.filter((other) => other.row !== row), selected].slice(-2);
  }
}

const runs = new Map<string, string>();

async function record(name: string, row: number): Promise<string> {
  const key = `${name} ${row}`;
  const run = runs.get(key) ?? (await replayRow(name, row)).run_id;
  runs.set(key, run);
  return run;
}

/** Record rows as runs: one for 3D, two for an overlay. */
export async function showRuns(numbers: readonly number[]): Promise<void> {
  const name = chosenName.peek();
  const created = await perform("see", async () => {
    const recorded: string[] = [];
    for (const row of numbers) recorded.push(await record(name, row));
    return recorded;
  });
  if (created === null) return;
  const [first = ""] = created;
  goTo(
    created.length > 1 ? { kind: "overlay", runs: created } : { kind: "run", run: first, timeS: 0 },
  );
}
