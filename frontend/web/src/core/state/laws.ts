/** The installed laws with their descriptions. */
import { computed, signal } from "@preact/signals";
import { readLaws } from "../api/client";
import type { Law, LawRow } from "../api/types";
import { t } from "../text/t";

const RETRY_MS = 2000;

export const laws = signal<readonly LawRow[]>([]);

/** The usable laws; a broken one is listed in `brokenLaws`. */
export const usableLaws = computed(() => laws.value.filter(({ problem }) => problem === null));
export const brokenLaws = computed(() => laws.value.filter(({ problem }) => problem !== null));

/**
 * Description of a law; undefined before the server has answered, and for a law that is not
 * installed.
 */
export const lawOf = (name: Law): LawRow | undefined => laws.value.find((law) => law.name === name);

/** Title of a law; its name if it has no description. */
export const titleOf = (name: Law): string => lawOf(name)?.title ?? name;

/**
 * A law of a record, which may not be installed: its title, or its name and the reason why it
 * cannot be used.
 */
export function describeLaw(name: Law): string {
  const law = lawOf(name);
  if (law?.problem) return t("laws.broken", { name });
  return law?.title ?? (laws.value.length > 0 ? t("laws.notInstalled", { name }) : name);
}

/** The default comparison for a law: the first other law. */
export const defaultComparisonLaw = (law: Law): Law | undefined =>
  usableLaws.value.find(({ name }) => name !== law)?.name;

const normalize = (words: string): string => words.toLowerCase().trim();

/** Laws that have every word in their name, title or summary. */
export function findLaws(candidates: readonly LawRow[], query: string): LawRow[] {
  const queryWords = normalize(query).split(/\s+/);
  return candidates.filter(({ name, title, summary }) => {
    const searchText = normalize(`${name} ${title} ${summary}`);
    return queryWords.every((word) => searchText.includes(word));
  });
}

const ESTIMATES = ["observer", "own", "none"] as const;

/** Groups by the source of their load estimate; with few laws there is one group. */
export const groupLaws = (candidates: readonly LawRow[]) =>
  ESTIMATES.map((estimate) => ({
    estimate,
    laws: candidates.filter((law) => law.estimate === estimate),
  })).filter((group) => group.laws.length > 0);

/** Selection by Enter: the law whose name was typed completely, or the first one found. */
export const pickLaw = (candidates: readonly LawRow[], query: string): LawRow | undefined =>
  candidates.find(({ title }) => normalize(title) === normalize(query)) ??
  groupLaws(candidates)[0]?.laws[0];

/** Read once, when the page opens: laws are installed before the lab starts. */
export async function openLaws(): Promise<void> {
  try {
    laws.value = await readLaws();
  } catch {
    setTimeout(() => void openLaws(), RETRY_MS);
  }
}
