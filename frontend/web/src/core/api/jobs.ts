/** Long work on the server: jobs of any kind, and the tuning of a law. */
import { API, request, sessionName } from "./request";
import type { components } from "./schema";
import type { Law } from "./types";

export type Job = components["schemas"]["JobState"];

const pathOf = (id: string): string => `jobs/${encodeURIComponent(id)}`;

export const listJobs = () => request("get", "jobs") as Promise<Job[]>;
export const readJob = (id: string) => request("get", pathOf(id)) as Promise<Job>;
export const stopJob = (id: string) => request("delete", pathOf(id)) as Promise<Job>;

// Tune a law on the server: start, follow, break off.

type Schemas = components["schemas"];

export type Tuning = Schemas["TuningState"];
export type Candidate = Schemas["CandidateState"];

const tuningPathOf = (id: string) => `tunings/${encodeURIComponent(id)}`;

/** It begins from what the law is set to in this session. */
export const startTuning = (law: Law, budget: number) =>
  request("post", "tunings", { law, budget, session: sessionName }) as Promise<Tuning>;
/** first: from which trial on they are told. */
export const readTuning = (id: string, first: number) =>
  request("get", `${tuningPathOf(id)}?first=${first}`) as Promise<Tuning>;
export const listTunings = () => request("get", "tunings") as Promise<Tuning[]>;
export const stopTuning = (id: string) => request("delete", tuningPathOf(id)) as Promise<Tuning>;
export const tunedFileOf = (id: string): string => new URL(`${tuningPathOf(id)}/file`, API).href;
