/** The ranking and the leaderboard: laws measured in the same scenarios, and runs of them. */

import type { Job } from "./jobs";
import { API, request } from "./request";
import type { components } from "./schema";
import type { SessionState } from "./types";

type Schemas = components["schemas"];

export type Results = Schemas["Results"];
export type Row = Schemas["Row"];
export type Outcome = Schemas["ScenarioOutcome"];
export type Family = Schemas["FamilyOutcome"];

export const readRanking = () => request("get", "ranking") as Promise<Results>;
/** A private session of a row in a scenario, with NDOBC as comparison. */
export const seeScenario = (row: string, scenario: string) =>
  request("post", "sessions", { from: "ranking", row, scenario }) as Promise<SessionState>;

// The leaderboard: laws on the hidden trials of a season, and their worst runs.

type Board = Schemas["LeaderboardState"];
export type BoardEntry = Board["entries"][number];
type Submission = Schemas["SubmissionState"];

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
