/** The season's entries, their order, and the law that is being measured. */
import { computed, effect, signal } from "@preact/signals";
import { type BoardEntry, measureLaws, readBoard, submitLaw } from "../../core/api/ranking";
import { isJobRunning } from "../../core/jobs/progress";
import { followResults } from "../../core/jobs/results";
import { place } from "../../runs/list/place";
import { sortEntries } from "./columns";

const results = followResults("submission", readBoard);
export const { result: board, problem, isBusy, job, open: openBoard, unfollow, cancel } = results;
/** Outcome of the last submission, if it already has an entry. */
export const existingEntryKey = signal("");
/** "column", or "-column" for descending order. */
export const sort = signal("rank");
/** Key of the last submission of this page. */
export const submittedKey = signal("");

export const entries = computed<readonly BoardEntry[]>(() => {
  const key = sort.value.replace(/^-/, "");
  return sortEntries(board.value?.entries ?? [], key, sort.value.startsWith("-"));
});
/** The entry whose worst run is shown; undefined if the address contains none of this season. */
export const shownEntry = computed(() => {
  const at = place.value;
  if (at.kind !== "leaderboard" || at.entry === "") return undefined;
  return board.value?.entries.find(({ key }) => key === at.entry);
});

/** The submitted law of the running job has its entry: the lab's own laws are measured after it. */
export const hasSubmittedEntry = computed(() => {
  const now = job.value;
  const runs = board.value?.runs ?? Number.POSITIVE_INFINITY;
  if (!isJobRunning(now) || now === null || now.total <= runs) return false;
  return entries.value.some((entry) => !entry.is_installed && entry.name === now.title);
});
const total = computed(() => job.value?.total ?? 0);
effect(() => {
  if (total.value > (board.peek()?.runs ?? Number.POSITIVE_INFINITY)) void results.read();
});

/** Submits a law to the season; false if rejected at once. */
export async function submit(submission: Parameters<typeof submitLaw>[0]): Promise<boolean> {
  existingEntryKey.value = "";
  const response = await results.perform("submit", () => submitLaw(submission));
  if (response === null) return false;
  submittedKey.value = response.key;
  const startedJob = response.job;
  if (startedJob === null) {
    existingEntryKey.value = response.key;
    await results.read();
  } else await results.follow(startedJob);
  return true;
}

/** Measure the lab's own laws that have no entry yet. */
export async function measureInstalledLaws(): Promise<void> {
  existingEntryKey.value = "";
  submittedKey.value = "";
  const startedJob = await results.perform("measure", measureLaws);
  if (startedJob !== null) await results.follow(startedJob);
}
