/** Long-running jobs on the server, of any kind, and the tuning of a law. */
import { call } from "./operations";
import { API } from "./request";
import type { components } from "./schema";

type Schemas = components["schemas"];

export type Job = Schemas["JobState"];

const pathOf = (id: string): string => `jobs/${encodeURIComponent(id)}`;

/** Jobs of this kind, or of all kinds, newest first; the server keeps at most 50. */
export const listJobs = async (kind?: Job["kind"]) =>
  (await call("get", "/jobs", { query: { kind } })).jobs;
export const startJob = (jobRequest: object) =>
  call("post", "/jobs", { body: jobRequest as never });
export const readJob = (id: string) => call("get", "/jobs/{job}", { path: { job: id } });
export const jobFileOf = (id: string): string => new URL(`${pathOf(id)}/file`, API).href;
export const stopJob = (id: string) => call("delete", "/jobs/{job}", { path: { job: id } });

// Tuning of a law: start, follow, cancel.

/** A job with its progress and result. */
export type Tuning = Job & Schemas["TuningResult"];
export type Candidate = Schemas["CandidateState"];

const readResult = (job: Job): Tuning => ({ ...job, ...(job.result as Schemas["TuningResult"]) });

export const startTuning = async (body: object) => readResult(await startJob(body));
/** first: index of the first trial to return. */
export const readTuning = async (id: string, first: number) =>
  readResult(await call("get", "/jobs/{job}", { path: { job: id }, query: { first } }));
export const listTunings = async () => (await listJobs("tuning")).map(readResult);
export { jobFileOf as tunedFileOf, stopJob as stopTuning };
