/** The experiment on the page, and a recorded run, as scripts. */

import { signal } from "@preact/signals";
import { LockedError, RefusedError } from "../../core/api/errors";
import { API } from "../../core/api/request";
import { readOrigin, readRunOrigin } from "../../core/api/runs";
import type { RunOrigin } from "../../core/api/types";
import { controllerNames } from "../../core/state/lanes";
import { phase } from "../../core/state/session";
import { t } from "../../core/text/t";
import { writeExperiment } from "./experiment";

/** Why the last script could not be made. */
export const scriptProblem = signal("");

const LAB = new URL("../..", API).href.replace(/\/$/, "");

async function write(read: () => Promise<RunOrigin>, title: string): Promise<string | null> {
  scriptProblem.value = "";
  try {
    const origin = await read();
    if (origin.problem === null) return writeExperiment(origin, title, LAB);
    scriptProblem.value = origin.problem;
  } catch (error) {
    if (error instanceof LockedError) phase.value = "locked";
    scriptProblem.value =
      error instanceof RefusedError ? error.message : t("connection.unreachable");
  }
  return null;
}

export const makeExperimentScript = (): Promise<string | null> =>
  write(
    readOrigin,
    t("script.experimentTitle", { laws: controllerNames.peek().join(t("compare.versus")) }),
  );

export const makeRunScript = (run: string, name: string): Promise<string | null> =>
  write(() => readRunOrigin(run), name);
