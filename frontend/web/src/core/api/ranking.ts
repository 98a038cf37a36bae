/** The ranking and the leaderboard: laws measured in the same scenarios, and their runs. */

import type { Job } from "./jobs";
import { API, request, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";
import type { SessionState } from "./types";

type Schemas = components["schemas"];

export type Results = Schemas["Results"];
export type Row = Schemas["Row"];
export type Outcome = Schemas["ScenarioOutcome"];
export type Family = Schemas["FamilyOutcome"];

export const readRanking = () => request("get", "ranking") as Promise<Results>;
/** Open a private session of one row in a scenario, with NDOBC as comparison. */
export const openRankingSession = (row: string, scenario: string) =>
  request(
    "post",
    "sessions",
    { from: "ranking", row, scenario },
    WORK_TIMEOUT_MS,
  ) as Promise<SessionState>;

// The leaderboard: laws on the hidden trials of a season, and their worst runs.

type Board = Schemas["LeaderboardState"];
export type BoardEntry = Board["entries"][number];
type Submission = Schemas["SubmissionState"];

/** The first request tests whether this machine can isolate a law. */
export const readBoard = () =>
  request("get", "leaderboard", undefined, WORK_TIMEOUT_MS) as Promise<Board>;
export const submitLaw = (submission: { name: string; author: string; law: string }) =>
  request("post", "leaderboard/submissions", submission, WORK_TIMEOUT_MS) as Promise<Submission>;
/** The installed laws that have no entry in this season. */
export const measureLaws = () => request("post", "leaderboard/laws") as Promise<Job>;
export const worstRunAddress = (key: string): string =>
  new URL(`leaderboard/entries/${encodeURIComponent(key)}/replay`, API).href;
