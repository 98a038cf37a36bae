/** Names of the types of the server's schema. */
import type { components, paths } from "./schema";

type Schemas = components["schemas"];

export type SessionState = Schemas["SessionState"];
export type Configuration = Schemas["ConfigurationState"];
export type PositionReference = Configuration["position"];
export type StiffnessReference = Configuration["stiffness"];
export type Effects = Configuration["effects"];
/** Effects that are left out are off, or have their defaults. */
export type EffectsRequest = {
  [K in keyof Effects]?: NonNullable<Effects[K]> extends object
    ? Partial<NonNullable<Effects[K]>> | null
    : Effects[K];
};
export type ActuatorParameters = Configuration["actuator"];
export type ActuatorRow = Schemas["ActuatorState"];
/** Controller of a comparison lane; null or left out: that of the session. */
export type Lane = Schemas["Lane"];
export type Gains = Schemas["Gains"];
export type SessionFault = NonNullable<SessionState["fault"]>;
export type EffectsPreset = Schemas["EffectsPreset"];
/** Descriptions of the exchangeable parts, except for laws. */
export type Kinds = Schemas["Kinds"];
export type EffectRow = Schemas["EffectState"];
/** A numeric field of a kind. */
export type ParameterRow = Schemas["ParameterState"];
/** A figure's run compared with the paper's claim. */
export type Claim = Schemas["ClaimState"];
export type ClaimNumbers = Claim["numbers"][number];
/** A row of the table of faults. */
/** Name of a law. */
export type Law = Configuration["law"];
export type LawRow = Omit<Schemas["LawState"], "parameters"> & { parameters: LawParameter[] };
/** Parameters of a law have defaults. */
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
export type Health = Schemas["Health"];
export type Figure = Schemas["FigureExperiment"]["figure"];
export type Refusal = Schemas["Problem"];
export type OutcomeState = Schemas["OutcomeState"];

/** Fields with defaults are optional in a request. */
type DefaultedField =
  | "comparison_laws"
  | "rise_s"
  | "transition_s"
  | "phase_rad"
  | "offset_rad"
  | "start_s"
  | "mass_kg"
  | "arm_m";
export type RequestOf<T> = T extends unknown
  ? Omit<T, DefaultedField> & Partial<Pick<T, Extract<DefaultedField, keyof T>>>
  : never;
export type Load = RequestOf<LoadRow["load"]>;

export type Method = "get" | "put" | "post" | "patch" | "delete";
export type Joint = number;

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
/** Name of a channel, as in the stream. */
export type StreamedName = Schemas["StreamChannel"]["name"];
export type RunOrigin = Schemas["RunOrigin"];
export type CommandKind = RunOrigin["commands"][number]["command"]["kind"];
export type ExportName =
  paths["/api/v1/runs/{run_id}/export"]["get"]["parameters"]["query"]["kind"];
