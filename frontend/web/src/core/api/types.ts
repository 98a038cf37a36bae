/** The names under which the page uses the server's schema. */
import type { components, paths } from "./schema";

type Schemas = components["schemas"];

export type SessionState = Schemas["SessionState"];
export type Configuration = Schemas["ConfigurationState"];
export type PositionReference = Configuration["position"];
export type StiffnessReference = Configuration["stiffness"];
export type Effects = Configuration["effects"];
/** What is left out is off, or has its default. */
export type EffectsRequest = {
  [K in keyof Effects]?: NonNullable<Effects[K]> extends object
    ? Partial<NonNullable<Effects[K]>> | null
    : Effects[K];
};
export type ActuatorParameters = Configuration["actuator"];
export type ActuatorRow = Schemas["ActuatorState"];
/** The controller of a comparison lane; null or left out: as the session's. */
export type Lane = Schemas["Lane"];
export type Gains = Schemas["Gains"];
export type SessionFault = NonNullable<SessionState["fault"]>;
export type EffectsPreset = Schemas["EffectsPreset"];
/** What varies, except for laws. */
export type Kinds = Schemas["Kinds"];
export type EffectRow = Schemas["EffectState"];
export type FormField = Schemas["FormField"];
/** A number that a kind of something has. */
export type ParameterRow = Schemas["ParameterState"];
/** A figure's run compared with the paper's claim. */
export type Claim = Schemas["ClaimState"];
export type ClaimNumbers = Claim["numbers"][number];
/** A row of the table of faults. */
export type FaultKind = Schemas["FaultKindState"];
/** The name of a law. */
export type Law = Configuration["law"];
export type LawRow = Omit<Schemas["LawState"], "parameters"> & { parameters: LawParameter[] };
/** A law's parameters have a default. */
export type LawParameter = Omit<ParameterRow, "default"> & {
  default: NonNullable<ParameterRow["default"]>;
};
export type Speed = SessionState["speed"];
export type LoadRow = Schemas["LoadState"];
export type LaneRow = SessionState["lanes"][number];
export type Metrics = NonNullable<LaneRow["since_start"]>;
export type WindowState = SessionState["window"];
export type SessionEvent = Schemas["Event"];
export type BenchState = NonNullable<SessionState["bench"]>;
export type BenchStatus = BenchState["status"];
export type LoopState = BenchState["loop"];
export type Axis = Schemas["HomingRequest"]["step"];
export type Figure = Schemas["FigureExperiment"]["figure"];
export type Refusal = Schemas["Problem"];
export type OutcomeState = Schemas["OutcomeState"];

/** What has a default may be left out of a request. */
type Defaulted =
  | "comparison_laws"
  | "rise_s"
  | "transition_s"
  | "phase_rad"
  | "offset_rad"
  | "start_s"
  | "mass_kg"
  | "arm_m";
export type Sent<T> = T extends unknown
  ? Omit<T, Defaulted> & Partial<Pick<T, Extract<Defaulted, keyof T>>>
  : never;
export type Load = Sent<LoadRow["load"]>;

export type Method = "get" | "put" | "post" | "patch" | "delete";
type Session = "/api/v1/sessions/{session}";
type Below<P> = P extends `${Session}${infer Rest}` ? Rest : never;
/** A path below a session, such as "/position". */
export type SessionPath = Below<keyof paths>;

type Operation<M extends Method, P extends SessionPath> = paths[`${Session}${P}`][M];
/** What a request must carry: nothing, or one body. */
export type Body<M extends Method, P extends SessionPath> =
  Operation<M, P> extends { requestBody: { content: { "application/json": infer B } } }
    ? [body: Sent<B>]
    : [];

export type RunSummary = Schemas["RunSummary"];
export type MeasuredWindow = Schemas["MeasuredWindow"];
export type RunDetails = Schemas["RunDetails"];
export type RunDifference = Schemas["RunDifference"];
export type RunVerdict = Schemas["RunVerdict"];
export type VerdictRequest = Schemas["VerdictRequest"];
export type RunList = Schemas["RunList"];
export type RunPatch = Schemas["RunPatch"];
export type RunSamples = Schemas["RunSamples"];
export type Hello = Schemas["Hello"];
/** A channel of the library, as the stream calls it. */
export type StreamedName = Schemas["StreamChannel"]["name"];
export type RunOrigin = Schemas["RunOrigin"];
export type CommandKind = RunOrigin["commands"][number]["command"]["kind"];
export type ExportName =
  paths["/api/v1/runs/{run_id}/export"]["get"]["parameters"]["query"]["kind"];
