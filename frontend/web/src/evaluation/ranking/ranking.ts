/** The published results, their order, and the row that is looked at. */
import { computed, signal } from "@preact/signals";
import { type Results, type Row, readRanking, seeScenario } from "../../core/api/ranking";
import { reading } from "../../core/jobs/poll";
import { explain, showErrorIn } from "../../core/state/actions";
import { titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { sortRows } from "./columns";

/** NDOBC with the gains declared for the paper. */
export const DECLARED = "ndobc_declared";

export const results = signal<Results | null>(null);
export const problem = signal("");
/** "column", or "-column" from the greatest down. */
export const sort = signal("rank");
/** Key of the row that is described. */
export const chosen = signal("");
export const opening = signal("");

export const rows = computed<readonly Row[]>(() => {
  const key = sort.value.replace(/^-/, "");
  return sortRows(results.value, key, sort.value.startsWith("-"));
});

export const titleOfRow = ({ key, law }: Pick<Row, "key" | "law">): string =>
  key === DECLARED ? text.ranking.declared(titleOf(law)) : titleOf(law);

const readResults = reading(showErrorIn(problem));

export async function openRanking(): Promise<void> {
  if (results.peek() !== null) return;
  await readResults(readRanking, (found) => {
    results.value = found;
    chosen.value = found.rows[0]?.key ?? "";
  });
}

/** Opens a private session of this run in the lab. */
export async function see(row: string, scenario: string): Promise<void> {
  opening.value = `${row} ${scenario}`;
  problem.value = "";
  try {
    const { session } = await seeScenario(row, scenario);
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
