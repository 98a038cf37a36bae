/** The ranking: what was published of the laws, the same measured here, and its runs to be seen. */
import { request } from "./request";
import type { components } from "./schema";
import type { Law, SessionState } from "./types";

type Schemas = components["schemas"];

export type Results = Schemas["Results"];
export type Row = Schemas["Row"];
export type Outcome = Schemas["Outcome"];
export type SweepOutcome = Schemas["SweepOutcome"];
export type MeasuredRow = Schemas["MeasuredRow"];

/** A worker that has to begin first, and to compile a law, takes its time. */
const LONGEST_MEASURING_MS = 120_000;

export const readRanking = () => request("get", "ranking") as Promise<Results>;
export const measureLaw = (law: Law) =>
  request(
    "post",
    `ranking/laws/${encodeURIComponent(law)}/measurement`,
    undefined,
    LONGEST_MEASURING_MS,
  ) as Promise<MeasuredRow>;
/** A private session of a law in a scenario, beside NDOBC. */
export const seeScenario = (law: Law, scenario: string) =>
  request("post", "ranking/sessions", { law, scenario }) as Promise<SessionState>;
