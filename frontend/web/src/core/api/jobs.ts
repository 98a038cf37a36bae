/** Long-running jobs on the server, of any kind, and the tuning of a law. */
import { API, request, sessionName } from "./request";
import type { components } from "./schema";
import type { Law } from "./types";

type Schemas = components["schemas"];

export type Job = Schemas["JobState"];

const pathOf = (id: string): string => `jobs/${encodeURIComponent(id)}`;

/** Jobs of this kind, or of all kinds, newest first; the server keeps at most 50. */
export const listJobs = async (kind?: Job["kind"]) =>
  ((await request("get", kind ? `jobs?kind=${kind}` : "jobs")) as Schemas["JobList"]).jobs;
export const startJob = (jobRequest: object) => request("post", "jobs", jobRequest) as Promise<Job>;
export const readJob = (id: string) => request("get", pathOf(id)) as Promise<Job>;
export const jobFileOf = (id: string): string => new URL(`${pathOf(id)}/file`, API).href;
export const stopJob = (id: string) => request("delete", pathOf(id)) as Promise<Job>;

// Tuning of a law: start, follow, cancel.

/** A job with its progress and result. */
export type Tuning = Job & Schemas["TuningResult"];
export type Candidate = Schemas["CandidateState"];

const readResult = (job: Job): Tuning => ({ ...job, ...(job.result as Schemas["TuningResult"]) });

/** Starts from the law's parameters in this session. */
export const startTuning = async (law: Law, budget: number) =>
  readResult(await startJob({ kind: "tuning", law, budget, session: sessionName }));
/** first: index of the first trial to return. */
export const readTuning = async (id: string, first: number) =>
  readResult((await request("get", `${pathOf(id)}?first=${first}`)) as Job);
export const listTunings = async () => (await listJobs("tuning")).map(readResult);
export { jobFileOf as tunedFileOf, stopJob as stopTuning };
