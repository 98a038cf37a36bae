/** The ranking and the leaderboard: laws measured in the same scenarios, and their runs. */

import { call } from "./operations";
import { API, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";

type Schemas = components["schemas"];

export type Results = Schemas["Results"];
export type Row = Schemas["Row"];
export type Outcome = Schemas["ScenarioOutcome"];
export type Family = Schemas["FamilyOutcome"];

export const readRanking = () => call("get", "/ranking", {});
/** Open a private session of one row in a scenario, with NDOBC as comparison. */
export const openRankingSession = (row: string, scenario: string) =>
  call("post", "/sessions", { body: { from: "ranking", row, scenario } }, WORK_TIMEOUT_MS);

// The leaderboard: laws on the hidden trials of a season, and their worst runs.

type Board = Schemas["LeaderboardState"];
export type BoardEntry = Board["entries"][number];

/** The first request tests whether this machine can isolate a law. */
export const readBoard = () => call("get", "/leaderboard", {}, WORK_TIMEOUT_MS);
export const submitLaw = (body: { name: string; author: string; law: string }) =>
  call("post", "/leaderboard/submissions", { body }, WORK_TIMEOUT_MS);
/** The installed laws that have no entry in this season. */
export const measureLaws = () => call("post", "/leaderboard/laws", {});
export const worstRunAddress = (key: string): string =>
  new URL(`leaderboard/entries/${encodeURIComponent(key)}/replay`, API).href;
