/** The laws that are installed, as each describes itself. */
import { computed, signal } from "@preact/signals";
import { readLaws } from "../api/client";
import type { Law, LawParameter, LawRow } from "../api/types";
import type { Quantity } from "../quantities";
import { lawsText as text } from "../text/controls";

const RETRY_MS = 2000;

export const laws = signal<readonly LawRow[]>([]);

/** Those that can be used; a broken one is named in `brokenLaws`. */
export const usableLaws = computed(() => laws.value.filter(({ problem }) => problem === null));
export const brokenLaws = computed(() => laws.value.filter(({ problem }) => problem !== null));

/** What the server says of a law; undefined before it has, and of a law that is not installed. */
export const lawOf = (name: Law): LawRow | undefined => laws.value.find((law) => law.name === name);

/** How a law is called; its name where nothing else is known. */
export const titleOf = (name: Law): string => lawOf(name)?.title ?? name;

/** A law of a record, which need not be here: its title, or its name and why it cannot be used. */
export function describeLaw(name: Law): string {
  const law = lawOf(name);
  if (law?.problem) return text.laws.broken(name);
  return law?.title ?? (laws.value.length > 0 ? text.laws.notInstalled(name) : name);
}

/** The default comparison law of a law: the first other one. */
export const otherLaw = (law: Law): Law | undefined =>
  usableLaws.value.find(({ name }) => name !== law)?.name;

const LONGEST_LABEL = 18;

/** A meaning that leaves no room for the slider stands above it, which then has the symbol. */
export const isWordy = ({ symbol, meaning }: LawParameter): boolean =>
  symbol !== "" && meaning.length > LONGEST_LABEL;

/** What a parameter's field is called; of several numbers each has its place. */
export function labelParameter(row: LawParameter, index: number | null): string {
  const label = isWordy(row) ? row.symbol : row.meaning;
  return index === null ? label : `${label} ${index + 1}`;
}

/**
 * The parameter of a path such as `lqi.position_rad`, or of a lane, `comparisons[0].parameters.rate[1]`,
 * which does not say of which law: null where laws call what has this name otherwise.
 */
export function parameterOf(path: string): Quantity | null {
  const [, law, name, place] = /(?:^|\.)(\w+)\.(\w+)(?:\[(\d+)\])?$/.exec(path) ?? [];
  const index = place === undefined ? null : Number(place);
  const [first, ...others] = laws.value
    .filter((one) => law === "parameters" || one.name === law)
    .flatMap(({ parameters }) => parameters.filter((row) => row.name === name))
    .map((row) => ({ label: labelParameter(row, index), unit: row.unit === "1" ? "" : row.unit }));
  if (first === undefined) return null;
  return others.every(({ label, unit }) => label === first.label && unit === first.unit)
    ? first
    : null;
}

const plain = (words: string): string => words.toLowerCase().trim();

/** Those that have every word in their name, title or summary. */
export function findLaws(listed: readonly LawRow[], sought: string): LawRow[] {
  const wanted = plain(sought).split(/\s+/);
  return listed.filter(({ name, title, summary }) => {
    const said = plain(`${name} ${title} ${summary}`);
    return wanted.every((word) => said.includes(word));
  });
}

const ESTIMATES = ["observer", "own", "none"] as const;

/** By whose estimate of the load they act on; while there are few it is one group. */
export const groupLaws = (listed: readonly LawRow[]) =>
  ESTIMATES.map((estimate) => ({
    estimate,
    laws: listed.filter((law) => law.estimate === estimate),
  })).filter((group) => group.laws.length > 0);

/** What Enter takes of those found: the law that was written out, or the first that is shown. */
export const pickLaw = (found: readonly LawRow[], sought: string): LawRow | undefined =>
  found.find(({ title }) => plain(title) === plain(sought)) ?? groupLaws(found)[0]?.laws[0];

/** When the page opens, once: laws are installed before the lab starts. */
export async function openLaws(): Promise<void> {
  try {
    laws.value = await readLaws();
  } catch {
    setTimeout(() => void openLaws(), RETRY_MS);
  }
}
