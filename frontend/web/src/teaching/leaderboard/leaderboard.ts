/** The season's entries, the order that they are shown in, and the law that is being measured. */
import { computed, effect, signal } from "@preact/signals";
import { type BoardEntry, measureLaws, readBoard, submitLaw } from "../../core/api/ranking";
import { isGoing } from "../../core/jobs/progress";
import { followResults } from "../../core/jobs/results";
import { place } from "../../runs/list/place";
import { sortEntries } from "./columns";

const results = followResults("submission", readBoard);
export const { found: board, problem, job, open: openBoard, leave, cancel } = results;
/** Outcome of the last submission, where it has an entry already. */
export const note = signal("");
/** "column", or "-column" from the greatest down. */
export const sort = signal("rank");
/** Key of what was submitted last from this page. */
export const submitted = signal("");
export const isAsking = signal(false);

export const entries = computed<readonly BoardEntry[]>(() => {
  const key = sort.value.replace(/^-/, "");
  return sortEntries(board.value?.entries ?? [], key, sort.value.startsWith("-"));
});
/** The entry whose worst run is looked at; undefined where the address names none of this season. */
export const looked = computed(() => {
  const at = place.value;
  if (at.kind !== "leaderboard" || at.entry === "") return undefined;
  return board.value?.entries.find(({ key }) => key === at.entry);
});

/** The law that the job under way began with has its entry: the lab's own are measured after it. */
export const isEntered = computed(() => {
  const now = job.value;
  const runs = board.value?.runs ?? Number.POSITIVE_INFINITY;
  if (!isGoing(now) || now === null || now.total <= runs) return false;
  return entries.value.some((one) => !one.is_installed && one.name === now.title);
});
const total = computed(() => job.value?.total ?? 0);
effect(() => {
  if (total.value > (board.peek()?.runs ?? Number.POSITIVE_INFINITY)) void results.read();
});

/** Submits a law to the season; false if rejected at once. */
export async function submit(wish: Parameters<typeof submitLaw>[0]): Promise<boolean> {
  note.value = "";
  isAsking.value = true;
  const made = await results.attempt(() => submitLaw(wish));
  isAsking.value = false;
  if (made === null) return false;
  submitted.value = made.key;
  const begun = made.job;
  if (begun === null) {
    note.value = made.key;
    await results.read();
  } else await results.follow(begun);
  return true;
}

/** Measures the lab's own laws that have no entry yet. */
export async function measureLab(): Promise<void> {
  note.value = "";
  submitted.value = "";
  const begun = await results.attempt(measureLaws);
  if (begun !== null) await results.follow(begun);
}
