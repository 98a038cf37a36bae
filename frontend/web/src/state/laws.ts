/** The laws that are installed, as each describes itself. */
import { computed, signal } from "@preact/signals";
import { readLaws } from "../api/client";
import type { Law, LawRow } from "../api/types";

export const laws = signal<readonly LawRow[]>([]);

/** Those that can be used; a broken one is named in `brokenLaws`. */
export const usableLaws = computed(() => laws.value.filter(({ problem }) => problem === null));
export const brokenLaws = computed(() => laws.value.filter(({ problem }) => problem !== null));

/** What the server says of a law; undefined before it has, and of a law that is not installed. */
export const lawOf = (name: Law): LawRow | undefined => laws.value.find((law) => law.name === name);

/** How a law is called; its name where nothing else is known. */
export const titleOf = (name: Law): string => lawOf(name)?.title ?? name;

/** The law to set beside this one where nobody has chosen: the first other one. */
export const otherLaw = (law: Law): Law | undefined =>
  usableLaws.value.find(({ name }) => name !== law)?.name;

/** Once, when the page opens: laws are installed before the lab starts. */
export async function openLaws(): Promise<void> {
  laws.value = await readLaws();
}
