/** Searches for the worst-case load of a law, and the scenarios saved from them. */
import { type Job, jobFileOf, listJobs, readJob, startJob, stopJob } from "./jobs";
import { call } from "./operations";
import { API, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";
import type { Law } from "./types";

type Schemas = components["schemas"];

/** A job with its progress and result. */
export type Search = Job & Schemas["FalsificationResult"];
export type AdversaryState = Schemas["AdversaryState"];
export type Adversary = Schemas["Adversary"];
export type Term = Adversary["terms"][number];
export type LawTrace = Schemas["LawTraceState"];
export type Trace = Schemas["ScenarioTraceState"];
export type SavedScenario = Schemas["SavedScenario"];
/** Content of its file. */
export type Scenario = SavedScenario["scenario"];

const readResult = (job: Job): Search => ({
  ...job,
  ...(job.result as Schemas["FalsificationResult"]),
});

export const listAdversaries = () => call("get", "/adversaries", {});
export const listSearches = async () => (await listJobs("falsification")).map(readResult);
export const startSearch = async (body: object) => readResult(await startJob(body));
export const readSearch = async (id: string) => readResult(await readJob(id));
export { jobFileOf as searchFileOf, stopJob as stopSearch };

export const listScenarios = () => call("get", "/scenarios", {});
export const saveScenario = (name: string, scenario: Scenario) =>
  call("put", "/scenarios/{scenario}", { path: { scenario: name }, body: scenario });
export const scenarioFileOf = (name: string): string =>
  new URL(`scenarios/${encodeURIComponent(name)}?format=toml`, API).href;
/** Outcome of each law, and its errors over time. */
export const traceLaws = (scenario: Scenario, laws: readonly Law[]) =>
  call("post", "/scenarios/runs", { body: { scenario, laws } }, WORK_TIMEOUT_MS);
/** Open a private session with several laws in lanes. */
export const openScenarioSession = (scenario: Scenario, laws: readonly Law[]) =>
  call("post", "/sessions", { body: { from: "scenario", scenario, laws } }, WORK_TIMEOUT_MS);
