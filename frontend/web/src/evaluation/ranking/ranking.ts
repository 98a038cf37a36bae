/** The published results, their order, and the selected row. */
import { computed, signal } from "@preact/signals";
import { openRankingSession, type Results, type Row, readRanking } from "../../core/api/ranking";
import { createWork } from "../../core/jobs/work";
import { titleOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { sortRows } from "./columns";

/** NDOBC with the gains that the project assumes for the paper. */
export const DECLARED = "ndobc_declared";

export const results = signal<Results | null>(null);
/** "column", or "-column" for descending order. */
export const sort = signal("rank");
/** Key of the selected row. */
export const chosen = signal("");

export const rows = computed<readonly Row[]>(() => {
  const key = sort.value.replace(/^-/, "");
  return sortRows(results.value, key, sort.value.startsWith("-"));
});

export const titleOfRow = ({ key, law }: Pick<Row, "key" | "law">): string =>
  key === DECLARED ? t("ranking.declared", { title: titleOf(law) }) : titleOf(law);

const { read, perform, ...work } = createWork();
export const { problem, isBusy } = work;

export async function openRanking(): Promise<void> {
  if (results.peek() !== null) return;
  await read(readRanking, (answer) => {
    results.value = answer;
    chosen.value = answer.rows[0]?.key ?? "";
  });
}

/** Opens a private session of this run in the lab. */
export async function openInLab(row: string, scenario: string): Promise<void> {
  await perform("open", async () => {
    const { session } = await openRankingSession(row, scenario);
    location.assign(`${location.pathname}?session=${encodeURIComponent(session)}`);
  });
}

const DOI = /doi:(10\.\d{4,}\/\S+)$/;

/** The source of a law, and its DOI; "" without one. */
export function splitSource(source: string): { said: string; doi: string } {
  const match = DOI.exec(source);
  if (match === null) return { said: source, doi: "" };
  return { said: source.slice(0, match.index), doi: match[1] ?? "" };
}
