/** The leaderboard: laws on a season that nobody knows, and their worst runs. */

import type { Job } from "./jobs";
import { API, request } from "./request";
import type { components } from "./schema";

type Schemas = components["schemas"];

export type Board = Schemas["LeaderboardState"];
export type BoardEntry = Board["entries"][number];
export type Submission = Schemas["SubmissionState"];

/** Whether this machine isolates a law is tried before the first answer. */
const LONG_WAIT_MS = 60_000;

export const readBoard = () =>
  request("get", "leaderboard", undefined, LONG_WAIT_MS) as Promise<Board>;
export const submitLaw = (wish: { name: string; author: string; law: string }) =>
  request("post", "leaderboard/submissions", wish, LONG_WAIT_MS) as Promise<Submission>;
/** The laws of the lab that have no entry in this season. */
export const measureLaws = () => request("post", "leaderboard/laws") as Promise<Job>;
export const worstRunAddress = (key: string): string =>
  new URL(`leaderboard/entries/${encodeURIComponent(key)}/replay`, API).href;
