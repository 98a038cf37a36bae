/** Select runs of a study, and record them for 3D or an overlay. */
import { readRow, replayRow } from "../../core/api/studies";
import { goTo } from "../../runs/list/place";
import { chosenName, selectedRows } from "./selection";
import { attempt, perform } from "./studies";

/** Select a run of the study. */
export async function selectRow(row: number): Promise<void> {
  const name = chosenName.peek();
  const known = selectedRows.peek();
  if (known.at(-1)?.row === row) return;
  const selected = await attempt(() => readRow(name, row));
  if (selected !== null) {
    selectedRows.value = [...known.filter((other) => other.row !== row), selected].slice(-2);
  }
}

const runs = new Map<string, string>();

async function record(name: string, row: number): Promise<string> {
  const key = `${name} ${row}`;
  const run = runs.get(key) ?? (await replayRow(name, row)).run_id;
  runs.set(key, run);
  return run;
}

/** Record rows as runs: one for 3D, two for an overlay. */
export async function showRuns(numbers: readonly number[]): Promise<void> {
  const name = chosenName.peek();
  const created = await perform("see", async () => {
    const recorded: string[] = [];
    for (const row of numbers) recorded.push(await record(name, row));
    return recorded;
  });
  if (created === null) return;
  const [first = ""] = created;
  goTo(
    created.length > 1 ? { kind: "overlay", runs: created } : { kind: "run", run: first, timeS: 0 },
  );
}
