/** The public REST API, one function per call. The page uses no other interface of the server. */

import type { ArmPatch, Joint } from "./arm";
import { ChangedError, RefusedError, UnansweredError } from "./errors";
import { awaitOutcome } from "./outcome";
import { API, client, DEFAULT_TIMEOUT_MS, request, sessionName, WORK_TIMEOUT_MS } from "./request";
import type {
  ActuatorParameters,
  Axis,
  Body,
  Configuration,
  EffectsRequest,
  Figure,
  Health,
  Kinds,
  Lane,
  Law,
  LawRow,
  Load,
  Method,
  PositionReference,
  RequestOf,
  SessionPath,
  SessionState,
  Speed,
  StiffnessReference,
} from "./types";

const SESSION = `sessions/${encodeURIComponent(sessionName)}`;
const STOP_TIMEOUT_MS = 1500;

/** Opens a private session, of an arm if one is named; returns its name. */
export const openPrivateSession = async (arm = "") => {
  const wanted = arm === "" ? {} : { from: "arm", arm };
  return ((await request("post", "sessions", wanted, WORK_TIMEOUT_MS)) as SessionState).session;
};

const SETTINGS =
  /^\/(position|stiffness|law|gains|parameters|observer|actuator|nominal|effects|lanes|arm)(\/|$)/;
const takesRevision = (method: Method, path: string): boolean =>
  (method === "put" || method === "patch") && SETTINGS.test(path);

const PER_JOINT =
  /^\/(position|stiffness|law|gains|parameters|observer|actuator|nominal|effects|loads)(\?|$)/;
let requestJoint: Joint | null = null;

/** The joint of an arm to which settings apply; null for both, and for a single joint. */
export function setRequestJoint(joint: Joint | null): void {
  requestJoint = joint;
}

/** Start a request for a joint; its path is fixed before the call returns. */
export function forJoint<T>(joint: Joint | null, start: () => T): T {
  const before = requestJoint;
  requestJoint = joint;
  try {
    return start();
  } finally {
    requestJoint = before;
  }
}

function withJoint(path: string, joint: Joint | null = requestJoint): string {
  if (joint === null || !PER_JOINT.test(path)) return path;
  return `${path}${path.includes("?") ? "&" : "?"}joint=${joint}`;
}

let expectedRevision: string | null = null;

/** Values that this page has set last, by path below the session, as the server confirmed them. */
const confirmedStates = new Map<string, SessionState>();
export const lastConfirmed = (path: string): SessionState | null =>
  confirmedStates.get(path) ?? null;

/** Revision of the state on which the next setting is based; the server rejects any other. */
export function expectRevision(revision: string | null): void {
  expectedRevision = revision;
}

async function sendSetting(method: Method, path: string, body: unknown): Promise<SessionState> {
  const match = expectedRevision === null ? {} : { "If-Match": `"${expectedRevision}"` };
  try {
    const state = (await request(
      method,
      SESSION + withJoint(path),
      body,
      DEFAULT_TIMEOUT_MS,
      match,
    )) as SessionState;
    expectedRevision = state.revision;
    confirmedStates.set(path, state);
    return state;
  } catch (error) {
    const isOutdated = error instanceof RefusedError && error.status === 412;
    throw isOutdated ? new ChangedError(error.message, path) : error;
  }
}

/** If no answer comes, query the outcome of the request and the state. */
async function send(method: Method, path: string, body?: unknown): Promise<SessionState> {
  try {
    if (takesRevision(method, path)) return await sendSetting(method, path, body);
    return (await request(method, SESSION + path, body)) as SessionState;
  } catch (error) {
    if (!(error instanceof UnansweredError) || error.request === null) throw error;
    await awaitOutcome(error);
    return readState();
  }
}

/** Send one call of the session; the server's schema types path and body. */
function call<M extends Method, P extends SessionPath>(method: M, path: P, ...body: Body<M, P>) {
  return send(method, path, body[0]);
}

export type GainsRequest = Body<"put", "/gains">[0];

export const readHealth = () => request("get", "health") as Promise<Health>;
export const readState = () => call("get", "");
export const putPosition = (reference: RequestOf<PositionReference>) =>
  call("put", "/position", reference);
export const putStiffness = (reference: RequestOf<StiffnessReference>) =>
  call("put", "/stiffness", reference);
/** Restart the current reference with a fade; of both joints each its own. */
async function repeatReference(name: "position" | "stiffness"): Promise<SessionState> {
  const { configuration } = await readState();
  const { arm } = configuration;
  const path = `/${name}?restart=true`;
  if (!arm) return send("put", path, configuration[name]);
  const of = { 1: configuration[name], 2: arm.joint2[name] };
  if (requestJoint !== null) return send("put", path, of[requestJoint]);
  await send("put", `${path}&joint=1`, of[1]);
  return send("put", `${path}&joint=2`, of[2]);
}

export const repeatPosition = () => repeatReference("position");
export const repeatStiffness = () => repeatReference("stiffness");
/** comparisons: laws of the comparison lanes in order; lanes that are left out keep their laws. */
export const putLaw = (law: Law, comparisons: readonly Law[]) =>
  call(
    "put",
    "/law",
    comparisons.length === 0 ? { law } : { law, comparison_laws: [...comparisons] },
  );
export const putGains = (gains: GainsRequest) => call("put", "/gains", gains);
/** Parameters by law name; those that are left out keep their values. */
export const putParameters = (parameters: Body<"put", "/parameters">[0]) =>
  call("put", "/parameters", parameters);
export const readLaws = () => request("get", "laws") as Promise<LawRow[]>;
export const putObserver = (link: number, motor1: number, motor2: number) =>
  call("put", "/observer", { bandwidth_rad_per_s: [link, motor1, motor2] });
export const putLanes = (comparisons: readonly Lane[]) =>
  call("put", "/lanes", { comparisons: [...comparisons] });
/** lane: its number, from 2; its plant keeps its state. */
export const putLane = (lane: number, controller: Lane) =>
  send("put", `/lanes/${lane}`, controller);
export const readKinds = () => request("get", "kinds") as Promise<Kinds>;
export const putEffects = (effects: EffectsRequest) => send("put", "/effects", effects);
/** patch: parameters by name; the session's actuator validates them. */
export const patchActuator = (patch: ActuatorParameters) => send("patch", "/actuator", patch);
export const patchNominal = (patch: ActuatorParameters) => send("patch", "/nominal", patch);
export const putNominal = (toml: string) => call("put", "/nominal", { toml });
export const startExcitation = (name: string) => call("post", "/excitation", { name });
export const stopExcitation = () => call("delete", "/excitation");
/** The run is named after its settings until a user renames it. */
export const startRecording = () => call("post", "/recording", { name: "", tags: [], notes: "" });
export const stopRecording = () => call("delete", "/recording");
export const putSpeed = (speed: Speed) => call("put", "/speed", { speed });
export const start = () => call("post", "/start");
export const pause = () => call("post", "/pause");
export const quickStop = () =>
  request("post", `${SESSION}/quick-stop`, undefined, STOP_TIMEOUT_MS) as Promise<SessionState>;
/** Needs no secret of the lab: every client may stop. */
export const quickStopWithoutLogin = () =>
  request("post", "quick-stop", undefined, STOP_TIMEOUT_MS);
export const armBench = () => call("post", "/bench/arm");
export const confirmHome = (step: Axis, by: string) => call("post", "/bench/home", { step, by });
export const clearBench = () => call("post", "/bench/clear");
export const restartBench = () => call("post", "/bench/restart");
export const reset = () => call("post", "/reset");
export const step = (ticks: number) => call("post", "/step", { ticks });
/** configuration: lanes and effects that the figure does not define. */
export const runFigure = (
  figure: Figure,
  law: Law,
  configuration: { comparisons?: Configuration["comparisons"]; effects?: EffectsRequest },
) => send("post", "/experiment", { figure, law, load: true, ...configuration });
/** Feedforward and adaptation act at once; links, model and the tip's reference restart the run. */
export const patchArm = (patch: ArmPatch) => send("patch", "/arm", patch);
export const addLoad = async (load: Load) => {
  await send("post", "torque_nm" in load ? withJoint("/loads") : "/loads", load);
  return readState();
};
export const removeLoad = (id: number) => send("delete", `/loads/${id}`);
export const removeAllLoads = () => call("delete", "/loads");
export const takeControl = (by: string, takeOver: boolean) =>
  call("put", "/control", { by, take_over: takeOver });
export const deleteControl = () => call("delete", "/control");
/** Pass control to a user in the queue; for the holder and the instructor. */
export const handControlOver = (to: string) => call("post", "/control/handover", { to });
export const lockControl = (locked: boolean) => call("put", "/control/lock", { locked });

export function streamAddress(rateHz: number, historyS: number, channels: readonly string[]): URL {
  const address = new URL(`${SESSION}/stream`, API);
  address.protocol = address.protocol.replace("http", "ws");
  address.searchParams.set("rate_hz", String(rateHz));
  address.searchParams.set("history_s", String(historyS));
  address.searchParams.set("live_first", "true");
  address.searchParams.set("lanes", "all");
  address.searchParams.set("channels", channels.join(","));
  address.searchParams.set("client", client);
  return address;
}
