/** Predictions for a design or a reference, computed by the server; the session stays unchanged. */
import { request, sessionName, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";
import type { Load, PositionReference, RequestOf, SessionState, StiffnessReference } from "./types";

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

const analyze = (designRequest: object) =>
  request("post", `${SESSION}/design`, designRequest, WORK_TIMEOUT_MS);

export const predict = (designRequest: PredictRequest) =>
  analyze({ kind: "prediction", ...designRequest }) as Promise<Prediction>;

/** On a bench: the motor that heat will limit under this load, and when; null if none. */
export const predictHeat = (load: Load) =>
  request("post", `${SESSION}/bench/endurance`, load, WORK_TIMEOUT_MS) as Promise<Endurance | null>;

export const requestResponse = (designRequest: DesignRequest) =>
  analyze({ kind: "response", ...designRequest }) as Promise<DesignResponse>;
export const requestStability = (designRequest: DesignRequest) =>
  analyze({ kind: "stability", ...designRequest }) as Promise<Stability>;
export const requestMargins = (designRequest: DesignRequest) =>
  analyze({ kind: "margins", ...designRequest }) as Promise<Margins>;
export const requestRegion = (designRequest: RegionRequest) =>
  analyze({ kind: "region", ...designRequest }) as Promise<Region>;
/** Open a private simulated session with this design, stable or not. */
export const simulateDesign = (designRequest: DesignRequest) =>
  request(
    "post",
    "sessions",
    { from: "session", id: sessionName, ...designRequest },
    WORK_TIMEOUT_MS,
  ) as Promise<SessionState>;

// Previews of references, and references from CSV files; the session stays unchanged.

export type Follows = "position" | "stiffness";
export type Reference = RequestOf<PositionReference> | RequestOf<StiffnessReference>;
export type Preview = Schemas["ReferencePreview"];
type Series = Schemas["PositionSeries"] | Schemas["StiffnessSeries"];

export const readSeries = (csv: string) =>
  request("post", "references/csv", csv) as Promise<Series>;
export const previewReference = (follows: Follows, reference: Reference) =>
  request("post", "references/preview", { follows, reference }) as Promise<Preview>;
