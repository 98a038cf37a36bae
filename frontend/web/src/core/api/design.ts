/** Predictions for a design or a reference, computed by the server; the session stays unchanged. */
import { call } from "./operations";
import { sessionName, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";
import type { Load, PositionReference, RequestOf, StiffnessReference } from "./types";

type Schemas = components["schemas"];

export type Prediction = Schemas["Prediction"];
export type DesignRequest = Omit<Partial<Schemas["AnalysisRequest"]>, "kind">;
export type DesignResponse = Schemas["ResponseState"];
export type Stability = Schemas["StabilityState"];
export type Margins = Schemas["MarginsState"];
type RegionRequest = Omit<Partial<Schemas["RegionRequest"]>, "kind">;
export type Region = Schemas["RegionState"];
export type StartOutcome = Schemas["StartOutcomeState"];
export type Endurance = Schemas["Endurance"];
type PredictRequest = Omit<Partial<Schemas["PredictionRequest"]>, "kind">;

const analyze = (designRequest: object) =>
  call("post", "/sessions/{session}/design", { body: designRequest as never }, WORK_TIMEOUT_MS);

export const predict = (designRequest: PredictRequest) =>
  analyze({ kind: "prediction", ...designRequest }) as Promise<Prediction>;

/** On a bench: the motor that heat will limit under this load, and when; null if none. */
export const predictHeat = (load: Load) =>
  call("post", "/sessions/{session}/bench/endurance", { body: load }, WORK_TIMEOUT_MS);

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
  call(
    "post",
    "/sessions",
    { body: { from: "session", id: sessionName, ...designRequest } },
    WORK_TIMEOUT_MS,
  );

// Previews of references, and references from CSV files; the session stays unchanged.

export type Follows = "position" | "stiffness";
export type Reference = RequestOf<PositionReference> | RequestOf<StiffnessReference>;
export type Preview = Schemas["ReferencePreview"];

export const readSeries = (csv: string) => call("post", "/references/csv", { body: csv });
export const previewReference = (follows: Follows, reference: Reference) =>
  call("post", "/references/preview", { body: { follows, reference } as never });
