/** Searches for the worst-case load of a law, and the scenarios saved from them. */
import { type Job, jobFileOf, listJobs, readJob, startJob, stopJob } from "./jobs";
import { API, request, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";
import type { Law, SessionState } from "./types";

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

/** What to search; one of adversary, text and definition. */
export interface SearchRequest {
  adversary?: string;
  text?: string;
  definition?: Adversary;
  law?: Law;
  runs: number;
  seed: number;
}

const readResult = (job: Job): Search => ({
  ...job,
  ...(job.result as Schemas["FalsificationResult"]),
});
const scenarioPath = (name: string, rest = ""): string =>
  `scenarios/${encodeURIComponent(name)}${rest}`;

export const listAdversaries = () => request("get", "adversaries") as Promise<AdversaryState[]>;
export const listSearches = async () => (await listJobs("falsification")).map(readResult);
export const startSearch = async (searchRequest: SearchRequest) =>
  readResult(await startJob({ kind: "falsification", ...searchRequest }));
export const readSearch = async (id: string) => readResult(await readJob(id));
export { jobFileOf as searchFileOf, stopJob as stopSearch };

export const listScenarios = () => request("get", "scenarios") as Promise<SavedScenario[]>;
export const saveScenario = (name: string, scenario: Scenario) =>
  request("put", scenarioPath(name), scenario) as Promise<SavedScenario>;
export const scenarioFileOf = (name: string): string =>
  new URL(`${scenarioPath(name)}?format=toml`, API).href;
/** Outcome of each law, and its errors over time. */
export const traceLaws = (scenario: Scenario, laws: readonly Law[]) =>
  request("post", "scenarios/runs", { scenario, laws }, WORK_TIMEOUT_MS) as Promise<Trace>;
/** Open a private session with several laws in lanes. */
export const openScenarioSession = (scenario: Scenario, laws: readonly Law[]) =>
  request(
    "post",
    "sessions",
    { from: "scenario", scenario, laws },
    WORK_TIMEOUT_MS,
  ) as Promise<SessionState>;
