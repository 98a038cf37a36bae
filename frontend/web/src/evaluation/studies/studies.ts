/** The studies of this lab, the one that is looked at, its rows, and what is picked of them. */
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
  type StudyWish,
  startStudy,
} from "../../core/api/studies";
import { polling, reading, unlessRefused } from "../../core/jobs/poll";
import { isGoing } from "../../core/jobs/progress";
import { asking, showErrorIn } from "../../core/state/actions";
import { goTo, keepLook, place } from "../../runs/list/place";
import { type Brushed, chooseAxes, readBrush, writeBrush } from "./look";
import { NOTHING, type Rows, unpackRows } from "./rows";

const GROWTH = 1.25;

export const list = signal<StudyList | null>(null);
export const study = signal<Study | null>(null);
export const rows = signal<Rows>(NOTHING);
export const summary = signal<StudySummary | null>(null);
export const indices = signal<readonly SobolIndices[]>([]);
export const picked = signal<readonly StudyRow[]>([]);
export const problem = signal("");
export const isBusy = signal("");

const look = computed(() => (place.value.kind === "studies" ? place.value.look : {}));
export const chosenName = computed(() => (place.value.kind === "studies" ? place.value.study : ""));
export const axes = computed((): Record<string, string> => {
  const columns = study.value?.columns ?? [];
  const known = Object.entries(look.value).filter(
    ([part, name]) => part !== "law" && columns.some((column) => column.name === name),
  );
  return { ...chooseAxes(columns), ...Object.fromEntries(known) };
});
/** The law whose runs the planes and the map show, or "" for every one; the first if none is said. */
export const shownLaw = computed(() => {
  const laws = study.value?.laws ?? [];
  const said = look.value.law ?? laws[0] ?? "";
  return laws.includes(said) ? said : "";
});
export const EVERY_LAW = "every";
export const brush = computed(() => readBrush(look.value.brush ?? ""));

export const setLook = (changed: Readonly<Record<string, string>>): void =>
  keepLook({ ...look.peek(), ...changed });
export const setBrush = (next: Brushed | null): void =>
  setLook({ brush: next === null ? "" : writeBrush(next) });

const attempt = asking(problem);
const poll = polling(showErrorIn(problem));
export const { leave } = poll;

const readList = reading(showErrorIn(problem));

export const openList = () =>
  readList(listStudies, (found) => {
    list.value = found;
  });

const wantedColumns = (names: Readonly<Record<string, string>>): string[] => [
  ...new Set(["law", "fault", "succeeded", ...Object.values(names)].filter((name) => name !== "")),
];

async function takeRows(name: string): Promise<void> {
  const packed = await readRows(name, wantedColumns(axes.peek()));
  if (chosenName.peek() === name) rows.value = unpackRows(packed);
}

export const fetchRows = (name: string) => attempt(() => takeRows(name));

async function sumUp(found: Study): Promise<void> {
  const read = await unlessRefused(readSummary(found.name), showErrorIn(problem));
  if (chosenName.peek() !== found.name) return;
  summary.value = read;
  if (found.study.sampling !== "sensitivity") return;
  const shares = await unlessRefused(readSensitivity(found.name, "succeeded"), () => {});
  if (chosenName.peek() === found.name) indices.value = shares ?? [];
}

/** Looks at a study, and follows it while it grows. */
export async function follow(name: string): Promise<void> {
  leave();
  problem.value = "";
  study.value = null;
  rows.value = NOTHING;
  summary.value = null;
  indices.value = [];
  picked.value = [];
  if (name === "") return;
  let shown = 0;
  await poll.follow(
    () => readStudy(name),
    async (found, isLeft) => {
      study.value = found;
      const isEnded = !isGoing(found.job);
      if (found.done > 0 && (isEnded || found.done > shown * GROWTH)) {
        await unlessRefused(takeRows(name), showErrorIn(problem));
        if (isLeft()) return false;
        shown = found.done;
      }
      if (!isEnded) return false;
      void openList();
      if (found.done > 0) await sumUp(found);
      return true;
    },
  );
}

/** Whether it was begun. */
export async function begin(wish: StudyWish): Promise<boolean> {
  problem.value = "";
  isBusy.value = "start";
  const begun = await attempt(() => startStudy(wish));
  isBusy.value = "";
  if (begun === null) return false;
  void openList();
  const isHere = chosenName.peek() === begun.name;
  goTo({ kind: "studies", study: begun.name, look: isHere ? look.peek() : {} });
  if (isHere) void follow(begun.name);
  return true;
}

export async function cancel(): Promise<void> {
  const job = study.peek()?.job;
  if (job) await attempt(() => stopJob(job.id));
}

/** Whether it is gone; then nothing is looked at. */
export async function remove(name: string): Promise<boolean> {
  problem.value = "";
  isBusy.value = "delete";
  const isGone =
    (await attempt(async () => {
      await deleteStudy(name);
      return true;
    })) !== null;
  isBusy.value = "";
  if (!isGone) return false;
  goTo({ kind: "studies", study: "", look: {} });
  await openList();
  return true;
}

/** The selected row; the previously selected one is kept for an overlay. */
export async function pick(row: number): Promise<void> {
  const name = chosenName.peek();
  const known = picked.peek();
  if (known.at(-1)?.row === row) return;
  const found = await attempt(() => readRow(name, row));
  if (found !== null) {
    picked.value = [...known.filter((one) => one.row !== row), found].slice(-2);
  }
}

const runs = new Map<string, string>();

async function record(name: string, row: number): Promise<string | null> {
  const key = `${name} ${row}`;
  const known = runs.get(key);
  if (known !== undefined) return known;
  const made = await attempt(() => replayRow(name, row));
  if (made === null) return null;
  runs.set(key, made.run_id);
  return made.run_id;
}

/** Rows as recorded runs: one in 3D, two laid over each other. */
export async function see(numbers: readonly number[]): Promise<void> {
  const name = chosenName.peek();
  problem.value = "";
  isBusy.value = "see";
  const made: string[] = [];
  for (const row of numbers) {
    const run = await record(name, row);
    if (run === null) break;
    made.push(run);
  }
  isBusy.value = "";
  if (made.length < numbers.length) return;
  const [first = ""] = made;
  goTo(made.length > 1 ? { kind: "overlay", runs: made } : { kind: "run", run: first, timeS: 0 });
}
