/** The table as it was published, rows as they were measured here, and what is looked at. */
import { computed, signal } from "@preact/signals";
import {
  measureLaw,
  type Results,
  type Row,
  readRanking,
  seeScenario,
} from "../../core/api/ranking";
import type { Law } from "../../core/api/types";
import type { LineStyle } from "../../core/plots/definitions";
import { lineStylesOfLaws } from "../../core/plots/linestyles";
import { explain } from "../../core/state/actions";
import { sortRows } from "./columns";

const PAPERS_LAW = "ndobc";
const MAX_CHOSEN = 4;

export const results = signal<Results | null>(null);
export const problem = signal("");
/** "column", or "-column" from the greatest down. */
export const sort = signal("-score");
/** Laws in the radar; the last is the one that is told of. */
export const chosen = signal<readonly Law[]>([]);
/** Of laws that were measured here: whether every number was the published one. */
export const confirmed = signal<Readonly<Record<Law, boolean>>>({});
/** How many laws are measured of how many; null while nothing is. */
export const measuring = signal<{ done: number; of: number; law: Law } | null>(null);
export const opening = signal("");

export const rows = computed<readonly Row[]>(() => {
  const key = sort.value.replace(/^-/, "");
  return sortRows(results.value?.rows ?? [], key, sort.value.startsWith("-"));
});

export const rowOf = (law: Law): Row | undefined =>
  results.value?.rows.find((row) => row.law === law);

/** The line styles of the laws in the radar. */
export const lineStyles = computed<ReadonlyMap<Law, LineStyle>>(() => {
  const shared = lineStylesOfLaws(chosen.value);
  return new Map(chosen.value.map((law, index) => [law, shared[index] as LineStyle]));
});

export async function openRanking(): Promise<void> {
  if (results.peek() !== null) return;
  try {
    const found = await readRanking();
    results.value = found;
    const best = sortRows(found.rows, "score", true).map(({ law }) => law);
    const comparisons = best.filter((law) => law !== PAPERS_LAW).slice(0, 2);
    chosen.value = [...comparisons.reverse(), PAPERS_LAW];
  } catch (error) {
    problem.value = explain(error);
  }
}

/** Into the radar as the one that is told of; out of it where it already is that. */
export function choose(law: Law): void {
  const others = chosen.peek().filter((one) => one !== law);
  const isDescribed = chosen.peek().at(-1) === law;
  chosen.value = isDescribed ? others : [...others, law].slice(-MAX_CHOSEN);
}

let round = 0;

export function stopMeasuring(): void {
  round++;
  measuring.value = null;
}

/** Law by law, until all are measured, one is refused, or it is stopped. */
export async function measureAll(): Promise<void> {
  const number = ++round;
  const laws = rows.peek().map(({ law }) => law);
  problem.value = "";
  confirmed.value = {};
  try {
    for (const [done, law] of laws.entries()) {
      measuring.value = { done, of: laws.length, law };
      const { row, is_published: isPublished } = await measureLaw(law);
      if (number !== round) return;
      confirmed.value = { ...confirmed.peek(), [law]: isPublished };
      const known = results.peek();
      if (known) {
        const measured = known.rows.map((one) => (one.law === law ? row : one));
        results.value = { ...known, rows: measured };
      }
    }
  } catch (error) {
    if (number === round) problem.value = explain(error);
  }
  if (number === round) measuring.value = null;
}

/** Opens a private session of this run in the lab. */
export async function see(law: Law, scenario: string): Promise<void> {
  opening.value = `${law} ${scenario}`;
  problem.value = "";
  try {
    const { session } = await seeScenario(law, scenario);
    location.assign(`${location.pathname}?session=${encodeURIComponent(session)}`);
  } catch (error) {
    problem.value = explain(error);
    opening.value = "";
  }
}

const DOI = /doi:(10\.\d{4,}\/\S+)$/;

/** What a law's source says, and the DOI at its end; "" where it names none. */
export function splitSource(source: string): { said: string; doi: string } {
  const found = DOI.exec(source);
  if (found === null) return { said: source, doi: "" };
  return { said: source.slice(0, found.index), doi: found[1] ?? "" };
}
