/** Long work on the server, of whatever kind. */
import { request } from "./request";
import type { components } from "./schema";

export type Job = components["schemas"]["JobState"];

const pathOf = (id: string): string => `jobs/${encodeURIComponent(id)}`;

export const listJobs = () => request("get", "jobs") as Promise<Job[]>;
export const readJob = (id: string) => request("get", pathOf(id)) as Promise<Job>;
export const stopJob = (id: string) => request("delete", pathOf(id)) as Promise<Job>;
