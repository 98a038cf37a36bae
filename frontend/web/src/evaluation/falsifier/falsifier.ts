/** The searches and scenarios of this lab, the one that is looked at, and laws to run in it. */
import { computed, signal } from "@preact/signals";
import {
  type AdversaryState,
  keepScenario,
  listAdversaries,
  listScenarios,
  listSearches,
  readSearch,
  runLaws,
  type SavedScenario,
  type Scenario,
  type Search,
  type SearchWish,
  seeLaws,
  startSearch,
  stopSearch,
  type Trace,
} from "../../core/api/falsifications";
import type { Law } from "../../core/api/types";
import { polling, reading } from "../../core/jobs/poll";
import { isGoing } from "../../core/jobs/progress";
import { asking, showErrorIn } from "../../core/state/actions";
import { goTo, place } from "../../runs/list/place";

const PAPERS_LAW = "ndobc";
const BASELINE = "fl";

export const adversaries = signal<readonly AdversaryState[]>([]);
export const searches = signal<readonly Search[] | null>(null);
export const kept = signal<readonly SavedScenario[] | null>(null);
export const search = signal<Search | null>(null);
/** The outcomes of the laws, with their scenario and laws, and where they are shown. */
export const traced = signal<{ at: string; key: string; trace: Trace } | null>(null);
export const problem = signal("");
export const isBusy = signal("");

export const chosen = computed(() =>
  place.value.kind === "falsifier" ? place.value : { search: "", scenario: "", laws: [] },
);

const at = computed(() => `${chosen.value.search} ${chosen.value.scenario}`);

/** The outcomes of the laws here, of the latest request. */
export const shown = computed(() => (traced.value?.at === at.value ? traced.value.trace : null));

/** The scenario that is looked at: a kept one, or the simplest or the worst of a search. */
export const scenario = computed((): Scenario | null => {
  const { scenario: name } = chosen.value;
  if (name !== "") return kept.value?.find((one) => one.name === name)?.scenario ?? null;
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
  neighbors_hurt?: number;
}
export const findingOf = (one: Scenario): Finding | null => (one.found as Finding) ?? null;

/** A law and its comparison: NDOBC, or FL for NDOBC itself. */
export const baselinesOf = (law: Law): readonly [Law, Law] => [
  law,
  law === PAPERS_LAW ? BASELINE : PAPERS_LAW,
];

/** The laws to run in it: the requested ones; else the one that it hurts, and
 * another one once the search has ended. */
export const laws = computed((): readonly Law[] => {
  if (chosen.value.laws.length > 0) return chosen.value.laws;
  const hurt = (scenario.value && findingOf(scenario.value)?.law) ?? PAPERS_LAW;
  return isGoing(search.value) ? [hurt] : baselinesOf(hurt);
});

const attempt = asking(problem);

const readLists = reading(showErrorIn(problem));

export const openLists = () =>
  readLists(
    () =>
      Promise.all([
        adversaries.peek().length > 0 ? adversaries.peek() : listAdversaries(),
        listSearches(),
        listScenarios(),
      ]),
    ([known, ended, named]) => {
      adversaries.value = known;
      searches.value = ended;
      kept.value = named;
    },
  );

const poll = polling(showErrorIn(problem));
export const { leave } = poll;

/** Looks at a search, and follows it until it has ended. */
export async function follow(id: string): Promise<void> {
  leave();
  problem.value = "";
  search.value = null;
  if (id === "") return;
  const ending = await poll.follow(
    () => readSearch(id),
    (found) => {
      search.value = found;
      return !isGoing(found);
    },
  );
  if (ending === "ended") void openLists();
  else if (ending === "refused") search.value = null;
}

export const keyOf = (one: Scenario, names: readonly Law[]): string =>
  JSON.stringify([one.loads, one.settings, one.base, one.duration_s, names]);

let isTracing = false;

/** Runs the laws in the open scenario; later requests come next. */
export async function runThem(): Promise<void> {
  if (isTracing) return;
  isTracing = true;
  try {
    for (;;) {
      const [one, names, here] = [scenario.peek(), laws.peek(), at.peek()];
      if (one === null) return;
      const key = keyOf(one, names);
      const last = traced.peek();
      if (last?.key === key && last.at === here) return;
      const found = await attempt(() => runLaws(one, names));
      if (here !== at.peek()) continue;
      if (found === null) return;
      traced.value = { at: here, key, trace: found };
    }
  } finally {
    isTracing = false;
  }
}

/** Whether it was begun. */
export async function begin(wish: SearchWish): Promise<boolean> {
  problem.value = "";
  isBusy.value = "begin";
  const begun = await attempt(() => startSearch(wish));
  isBusy.value = "";
  if (begun === null) return false;
  void openLists();
  goTo({ kind: "falsifier", search: begun.id, scenario: "", laws: [] });
  return true;
}

export async function cancel(): Promise<void> {
  const going = search.peek();
  if (going !== null) await attempt(() => stopSearch(going.id));
}

/** Keeps what is looked at by a name, and goes there. */
export async function keep(name: string): Promise<void> {
  const one = scenario.peek();
  if (one === null) return;
  problem.value = "";
  isBusy.value = "keep";
  const made = await attempt(() => keepScenario(name, one));
  if (made !== null) {
    await openLists();
    goTo({ kind: "falsifier", search: "", scenario: made.name, laws: chosen.peek().laws });
  }
  isBusy.value = "";
}

/** Opens a private session of a law under it, compared with the searched law. */
export async function see(law: Law): Promise<void> {
  const one = scenario.peek();
  if (one === null) return;
  problem.value = "";
  isBusy.value = `see ${law}`;
  const hurt = findingOf(one)?.law ?? law;
  const pair = law === hurt ? baselinesOf(law) : [law, hurt];
  const made = await attempt(() => seeLaws(one, pair));
  isBusy.value = "";
  if (made !== null) {
    location.assign(`${location.pathname}?session=${encodeURIComponent(made.session)}`);
  }
}
