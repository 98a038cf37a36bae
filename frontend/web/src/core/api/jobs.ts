/** Long work on the server: jobs of any kind, and the tuning of a law. */
import { API, request, sessionName } from "./request";
import type { components } from "./schema";
import type { Law } from "./types";

type Schemas = components["schemas"];

export type Job = Schemas["JobState"];

const pathOf = (id: string): string => `jobs/${encodeURIComponent(id)}`;

/** Of this kind if one is given, the newest first: at most 50, which are all that a server stores. */
export const listJobs = async (kind?: Job["kind"]) =>
  ((await request("get", kind ? `jobs?kind=${kind}` : "jobs")) as Schemas["JobList"]).jobs;
export const startJob = (wish: object) => request("post", "jobs", wish) as Promise<Job>;
export const readJob = (id: string) => request("get", pathOf(id)) as Promise<Job>;
export const jobFileOf = (id: string): string => new URL(`${pathOf(id)}/file`, API).href;
export const stopJob = (id: string) => request("delete", pathOf(id)) as Promise<Job>;

// Tune a law on the server: start, follow, break off.

/** A job, with its result next to its progress. */
export type Tuning = Job & Schemas["TuningResult"];
export type Candidate = Schemas["CandidateState"];

const readResult = (job: Job): Tuning => ({ ...job, ...(job.result as Schemas["TuningResult"]) });

/** It begins from what the law is set to in this session. */
export const startTuning = async (law: Law, budget: number) =>
  readResult(await startJob({ kind: "tuning", law, budget, session: sessionName }));
/** first: index of the first trial to return. */
export const readTuning = async (id: string, first: number) =>
  readResult((await request("get", `${pathOf(id)}?first=${first}`)) as Job);
export const listTunings = async () => (await listJobs("tuning")).map(readResult);
export { jobFileOf as tunedFileOf, stopJob as stopTuning };
