/** The rows and results of the selected study, and the requests of the page. */
import { signal } from "@preact/signals";
import { stopJob } from "../../core/api/jobs";
import {
  deleteStudy,
  listStudies,
  readRows,
  readSensitivity,
  readStudy,
  readSummary,
  type SobolIndices,
  type Study,
  type StudySummary,
  startStudy,
} from "../../core/api/studies";
import { nullIfRejected } from "../../core/jobs/poll";
import { isJobRunning } from "../../core/jobs/progress";
import { createWork } from "../../core/jobs/work";
import { goTo } from "../../runs/list/place";
import { NOTHING, type Rows, unpackRows } from "./rows";
import { axes, chosenName, list, selectedRows, study, view } from "./selection";

const GROWTH = 1.25;

export const rows = signal<Rows>(NOTHING);
export const summary = signal<StudySummary | null>(null);
export const indices = signal<readonly SobolIndices[]>([]);

const { poll, read, run, showError, ...work } = createWork();
export const { attempt, perform, problem, isBusy, leave, stopFollowing } = work;

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
