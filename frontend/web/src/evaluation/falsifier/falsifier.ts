/** The searches and scenarios of this lab, the selected one, and the laws to run in it. */
import { computed, signal } from "@preact/signals";
import {
  type AdversaryState,
  listAdversaries,
  listScenarios,
  listSearches,
  openScenarioSession,
  readSearch,
  type SavedScenario,
  type Scenario,
  type Search,
  saveScenario,
  startSearch,
  stopSearch,
} from "../../core/api/falsifications";
import type { Law } from "../../core/api/types";
import { isJobRunning } from "../../core/jobs/progress";
import { createWork } from "../../core/jobs/work";
import { goTo, place, storeLaws } from "../../runs/list/place";

const PAPERS_LAW = "ndobc";
const BASELINE = "fl";

export const adversaries = signal<readonly AdversaryState[]>([]);
export const searches = signal<readonly Search[] | null>(null);
export const savedScenarios = signal<readonly SavedScenario[] | null>(null);
export const search = signal<Search | null>(null);
const NO_SELECTION = { search: "", scenario: "", laws: [] as readonly Law[] };

/** What the address names, else the latest search or a saved scenario; before these the example. */
export const selection = computed(() => {
  const inAddress = place.value.kind === "falsifier" ? place.value : NO_SELECTION;
  if (inAddress.search !== "" || inAddress.scenario !== "") return inAddress;
  const latest = searches.value?.[0]?.id ?? "";
  const scenario = latest === "" ? (savedScenarios.value?.[0]?.name ?? "") : "";
  return { search: latest, scenario, laws: inAddress.laws };
});

export const selectionKey = computed(() => `${selection.value.search} ${selection.value.scenario}`);

/** Undefined unless a saved scenario is selected. */
export const savedScenario = computed(() =>
  savedScenarios.value?.find(({ name }) => name === selection.value.scenario),
);

/** The selected scenario: a saved one, or the simplest or the worst one of a search. */
export const scenario = computed((): Scenario | null => {
  if (selection.value.scenario !== "") return savedScenario.value?.scenario ?? null;
  return search.value?.scenario ?? search.value?.worst ?? null;
});

interface Finding {
  adversary: string;
  law: Law;
  cost: string;
  outcome: string;
  at_run: number;
  runs: number;
  seed: number;
  neighbors?: number;
  neighbors_failed?: number;
}
export const findingOf = (searched: Scenario): Finding | null =>
  (searched.found as Finding) ?? null;

/** A law and its comparison: NDOBC, or FL for NDOBC itself. */
export const baselinesOf = (law: Law): readonly [Law, Law] => [
  law,
  law === PAPERS_LAW ? BASELINE : PAPERS_LAW,
];

/**
 * The laws to run in it: the requested ones; otherwise the searched law, and another one once the
 * search has ended.
 */
export const laws = computed((): readonly Law[] => {
  if (selection.value.laws.length > 0) return selection.value.laws;
  const searchedLaw = (scenario.value && findingOf(scenario.value)?.law) ?? PAPERS_LAW;
  return isJobRunning(search.value) ? [searchedLaw] : baselinesOf(searchedLaw);
});

export const setLaws = (names: readonly Law[]): void => storeLaws(selection.peek(), names);

const { perform, poll, read, run, ...work } = createWork();
export const { attempt, problem, isBusy, leave, stopFollowing } = work;

export const openLists = () =>
  read(
    () =>
      Promise.all([
        adversaries.peek().length > 0 ? adversaries.peek() : listAdversaries(),
        listSearches(),
        listScenarios(),
      ]),
    ([known, ended, named]) => {
      adversaries.value = known;
      searches.value = ended;
      savedScenarios.value = named;
    },
  );

/** Select a search, and follow it until it has ended. */
export async function follow(id: string): Promise<void> {
  stopFollowing();
  search.value = null;
  if (id === "") return;
  const pollEnd = await poll(
    () => readSearch(id),
    (polledSearch) => {
      search.value = polledSearch;
      return !isJobRunning(polledSearch);
    },
  );
  if (pollEnd === "ended") void openLists();
  else if (pollEnd === "refused") search.value = null;
}

/** Start and select it; throws if it is rejected. */
export async function startNewSearch(request: object): Promise<void> {
  const started = await run("begin", () => startSearch(request));
  void openLists();
  goTo({ kind: "falsifier", search: started.id, scenario: "", laws: [] });
}

export async function cancel(): Promise<void> {
  const running = search.peek();
  if (running !== null) await attempt(() => stopSearch(running.id));
}

/** Save the selected scenario under a name, and select the saved one. */
export async function saveSelection(name: string): Promise<void> {
  const shown = scenario.peek();
  if (shown === null) return;
  await perform("keep", async () => {
    const created = await saveScenario(name, shown);
    await openLists();
    goTo({ kind: "falsifier", search: "", scenario: created.name, laws: selection.peek().laws });
  });
}

/** Open a private session of a law under it, compared with the searched law. */
export async function openInLab(law: Law): Promise<void> {
  const shown = scenario.peek();
  if (shown === null) return;
  const searchedLaw = findingOf(shown)?.law ?? law;
  const pair = law === searchedLaw ? baselinesOf(law) : [law, searchedLaw];
  const created = await perform(`see ${law}`, () => openScenarioSession(shown, pair));
  if (created !== null) {
    location.assign(`${location.pathname}?session=${encodeURIComponent(created.session)}`);
  }
}
