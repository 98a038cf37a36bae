/** The experiment on the page, and a recorded run, as scripts. */

import { signal } from "@preact/signals";
import { LockedError, RefusedError } from "../../core/api/errors";
import { API } from "../../core/api/request";
import { readOrigin, readRunOrigin } from "../../core/api/runs";
import { laneNames } from "../../core/state/lanes";
import { phase } from "../../core/state/session";
import { text } from "../../core/text/en";
import { writeExperiment } from "./experiment";

/** Why the last script could not be made. */
export const scriptProblem = signal("");

const LAB = new URL("../..", API).href.replace(/\/$/, "");

async function attempt(make: () => Promise<string>): Promise<string | null> {
  scriptProblem.value = "";
  try {
    return await make();
  } catch (error) {
    if (error instanceof LockedError) phase.value = "locked";
    scriptProblem.value =
      error instanceof RefusedError ? error.message : text.connection.unreachable;
    return null;
  }
}

export const makeExperimentScript = (): Promise<string | null> =>
  attempt(async () => {
    const title = text.script.experimentTitle(text.compare.versus(laneNames.peek()));
    return writeExperiment(await readOrigin(), title, LAB);
  });

export const makeRunScript = (run: string, name: string): Promise<string | null> =>
  attempt(async () => writeExperiment(await readRunOrigin(run), name, LAB));
