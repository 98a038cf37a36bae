/** What the server computes in advance for a design or a reference; the session stays unchanged. */
import { request, sessionName } from "./request";
import type { components } from "./schema";
import type { Load, PositionReference, Sent, SessionState, StiffnessReference } from "./types";

type Schemas = components["schemas"];

export type Prediction = Schemas["Prediction"];
export type DesignRequest = Omit<Partial<Schemas["AnalysisRequest"]>, "kind">;
export type DesignResponse = Schemas["ResponseState"];
export type Stability = Schemas["StabilityState"];
export type Margins = Schemas["MarginsState"];
type RegionRequest = Omit<Partial<Schemas["RegionRequest"]>, "kind">;
export type Region = Schemas["RegionState"];
export type StartOutcome = Schemas["StartOutcomeState"];
export type Endurance = Schemas["EnduranceState"];
type PredictRequest = Omit<Partial<Schemas["PredictionRequest"]>, "kind">;

const SESSION = `sessions/${encodeURIComponent(sessionName)}`;
/** A worker that has to begin first takes its time. */
const LONGEST_WORK_MS = 30_000;

const analyze = (wanted: object) => request("post", `${SESSION}/design`, wanted, LONGEST_WORK_MS);

export const predict = (wanted: PredictRequest) =>
  analyze({ kind: "prediction", ...wanted }) as Promise<Prediction>;

/** On a bench: the motor that heat holds back under this load, and when; null where neither is. */
export const predictHeat = (load: Load) =>
  request("post", `${SESSION}/bench/endurance`, load, LONGEST_WORK_MS) as Promise<Endurance | null>;

export const askResponse = (wanted: DesignRequest) =>
  analyze({ kind: "response", ...wanted }) as Promise<DesignResponse>;
export const askStability = (wanted: DesignRequest) =>
  analyze({ kind: "stability", ...wanted }) as Promise<Stability>;
export const askMargins = (wanted: DesignRequest) =>
  analyze({ kind: "margins", ...wanted }) as Promise<Margins>;
export const askRegion = (wanted: RegionRequest) =>
  analyze({ kind: "region", ...wanted }) as Promise<Region>;
/** A private simulated session with this design, stable or not. */
export const simulateDesign = (wanted: DesignRequest) =>
  request("post", "sessions", {
    from: "session",
    id: sessionName,
    ...wanted,
  }) as Promise<SessionState>;

// References before they are followed: read from a CSV, and looked at; nothing is changed.

export type Follows = "position" | "stiffness";
export type Reference = Sent<PositionReference> | Sent<StiffnessReference>;
export type Preview = Schemas["ReferencePreview"];
type Series = Schemas["PositionSeries"] | Schemas["StiffnessSeries"];

export const readSeries = (csv: string) =>
  request("post", "references/csv", csv) as Promise<Series>;
export const previewReference = (follows: Follows, reference: Reference) =>
  request("post", "references/preview", { follows, reference }) as Promise<Preview>;
