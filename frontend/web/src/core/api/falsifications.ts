/** Searches for the load that hurts a law most, and the scenarios that are kept of them. */
import { type Job, jobFileOf, listJobs, readJob, startJob, stopJob } from "./jobs";
import { API, request } from "./request";
import type { components } from "./schema";
import type { Law, SessionState } from "./types";

type Schemas = components["schemas"];

/** A job, with its result next to its progress. */
export type Search = Job & Schemas["FalsificationResult"];
export type AdversaryState = Schemas["AdversaryState"];
export type Adversary = Schemas["Adversary"];
export type Term = Adversary["terms"][number];
export type LawTrace = Schemas["LawTraceState"];
export type Trace = Schemas["ScenarioTraceState"];
export type SavedScenario = Schemas["SavedScenario"];
/** As it would stand in its file. */
export type Scenario = SavedScenario["scenario"];

/** What is searched; one of adversary, text and definition. */
export interface SearchWish {
  adversary?: string;
  text?: string;
  definition?: Adversary;
  law?: Law;
  runs: number;
  seed: number;
}

/** Many laws, some of which have to be compiled first. */
const LONG_WAIT_MS = 180_000;
const readResult = (job: Job): Search => ({
  ...job,
  ...(job.result as Schemas["FalsificationResult"]),
});
const scenarioPath = (name: string, rest = ""): string =>
  `scenarios/${encodeURIComponent(name)}${rest}`;

export const listAdversaries = () => request("get", "adversaries") as Promise<AdversaryState[]>;
export const listSearches = async () => (await listJobs("falsification")).map(readResult);
export const startSearch = async (wish: SearchWish) =>
  readResult(await startJob({ kind: "falsification", ...wish }));
export const readSearch = async (id: string) => readResult(await readJob(id));
export { jobFileOf as searchFileOf, stopJob as stopSearch };

export const listScenarios = () => request("get", "scenarios") as Promise<SavedScenario[]>;
export const keepScenario = (name: string, scenario: Scenario) =>
  request("put", scenarioPath(name), scenario) as Promise<SavedScenario>;
export const scenarioFileOf = (name: string): string =>
  new URL(`${scenarioPath(name)}?format=toml`, API).href;
/** The outcome of each law, and its errors over time. */
export const runLaws = (scenario: Scenario, laws: readonly Law[]) =>
  request("post", "scenarios/runs", { scenario, laws }, LONG_WAIT_MS) as Promise<Trace>;
/** A private session with several laws in lanes. */
export const seeLaws = (scenario: Scenario, laws: readonly Law[]) =>
  request("post", "sessions", { from: "scenario", scenario, laws }) as Promise<SessionState>;
