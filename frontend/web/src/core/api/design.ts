/** Ask the server what gains and observer would do; nothing is changed by it. */
import { request, sessionName } from "./request";
import type { components } from "./schema";
import type { Load, SessionState } from "./types";

type Schemas = components["schemas"];

export type Prediction = Schemas["Prediction"];
export type DesignRequest = Partial<Schemas["DesignRequest"]>;
export type DesignResponse = Schemas["ResponseState"];
export type Stability = Schemas["StabilityState"];
export type RegionRequest = Partial<Schemas["RegionRequest"]>;
export type Region = Schemas["RegionState"];
export type Fate = Schemas["FateState"];
export type Endurance = Schemas["EnduranceState"];
export type PredictRequest = Partial<Schemas["PredictRequest"]>;

const SESSION = `sessions/${encodeURIComponent(sessionName)}`;
/** A worker that has to begin first takes its time. */
const LONGEST_WORK_MS = 30_000;

export const predict = (wanted: PredictRequest) =>
  request("post", `${SESSION}/predict`, wanted, LONGEST_WORK_MS) as Promise<Prediction>;

/** On a bench: the motor that heat holds back under this load, and when; null where neither is. */
export const foretellHeat = (load: Load) =>
  request("post", `${SESSION}/bench/endurance`, load, LONGEST_WORK_MS) as Promise<Endurance | null>;

export const askResponse = (wanted: DesignRequest) =>
  request("post", `${SESSION}/design/response`, wanted, LONGEST_WORK_MS) as Promise<DesignResponse>;
export const askStability = (wanted: DesignRequest) =>
  request("post", `${SESSION}/design/stability`, wanted, LONGEST_WORK_MS) as Promise<Stability>;
export const askRegion = (wanted: RegionRequest) =>
  request("post", `${SESSION}/design/region`, wanted, LONGEST_WORK_MS) as Promise<Region>;
/** A private simulated session with this design, stable or not. */
export const simulateDesign = (wanted: DesignRequest) =>
  request("post", `${SESSION}/design/simulation`, wanted) as Promise<SessionState>;
