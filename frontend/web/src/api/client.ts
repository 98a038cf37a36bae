/** The public REST API, one function a call. The page has no other door to the server. */
import { noteCall } from "../script/calls";
import { LockedError, RefusedError, UnreachableError } from "./errors";
import { client } from "./identity";
import type {
  Axis,
  Body,
  Configuration,
  EffectsRequest,
  Figure,
  Law,
  Load,
  Method,
  PositionReference,
  Refusal,
  Sent,
  SessionPath,
  SessionState,
  Speed,
  StiffnessReference,
} from "./types";

export const API = new URL("api/v1/", document.baseURI);
const SHARED = "lab";
/** The session that this page shows: the shared one, or the private one that its address names. */
export const sessionName = new URLSearchParams(location.search).get("session") ?? SHARED;
export const isPrivate = sessionName !== SHARED;
const SESSION = `sessions/${encodeURIComponent(sessionName)}`;
const CLIENT_HEADER = "SVSA-Client";
const LONGEST_WAIT_MS = 6000;
const LONGEST_STOP_MS = 1500;

export async function request(
  method: Method,
  path: string,
  body?: unknown,
  waitMs = LONGEST_WAIT_MS,
): Promise<unknown> {
  const init: RequestInit = {
    method: method.toUpperCase(),
    cache: "no-store",
    headers: { [CLIENT_HEADER]: client },
    signal: AbortSignal.timeout(waitMs),
  };
  if (body !== undefined) {
    init.headers = { [CLIENT_HEADER]: client, "Content-Type": "application/json" };
    init.body = JSON.stringify(body);
  }
  let response: Response;
  try {
    response = await fetch(new URL(path, API), init);
  } catch (cause) {
    noteCall(method, path, body, null);
    throw new UnreachableError(cause);
  }
  const answer: unknown = await response.json().catch(() => null);
  noteCall(method, path, body, response.status, answer);
  if (response.ok) return answer;
  const refusal = answer as Partial<Refusal> | null;
  const message =
    refusal?.violations?.[0]?.message ??
    refusal?.message ??
    `${response.status} ${response.statusText}`;
  if (response.status === 401) throw new LockedError(message);
  throw new RefusedError(response.status, message);
}

function send(method: Method, path: SessionPath, body?: unknown) {
  return request(method, SESSION + path, body) as Promise<SessionState>;
}

/** One call on the session; path and body are checked against the server's schema. */
function call<M extends Method, P extends SessionPath>(method: M, path: P, ...body: Body<M, P>) {
  return send(method, path, body[0]);
}

export type GainsRequest = Body<"put", "/gains">[0];
export type ActuatorPatch = Body<"patch", "/actuator">[0];

export const readState = () => call("get", "");
export const putPosition = (reference: Sent<PositionReference>) =>
  call("put", "/position", reference);
export const putStiffness = (reference: Sent<StiffnessReference>) =>
  call("put", "/stiffness", reference);
export const putLaw = (law: Law) => call("put", "/law", { law });
export const putGains = (gains: GainsRequest) => call("put", "/gains", gains);
export const putObserver = (link: number, motor1: number, motor2: number) =>
  call("put", "/observer", { bandwidth_rad_per_s: [link, motor1, motor2] });
export const putLanes = (laws: readonly Law[]) =>
  call("put", "/lanes", { rivals: laws.map((law) => ({ law })) });
export const putEffects = (effects: EffectsRequest) => send("put", "/effects", effects);
export const patchActuator = (patch: ActuatorPatch) => call("patch", "/actuator", patch);
export const patchNominal = (patch: ActuatorPatch) => call("patch", "/nominal", patch);
export const startRecording = (name: string) =>
  call("post", "/recording", { name, tags: [], notes: "" });
export const stopRecording = () => call("delete", "/recording");
export const putSpeed = (factor: Speed) => call("put", "/speed", { factor });
export const start = () => call("post", "/start");
export const pause = () => call("post", "/pause");
export const stopAtOnce = () =>
  request("post", `${SESSION}/quick-stop`, undefined, LONGEST_STOP_MS) as Promise<SessionState>;
/** Without the lab's secret: stopping is open to all. */
export const stopWithoutLogin = () => request("post", "quick-stop", undefined, LONGEST_STOP_MS);
export const armBench = () => call("post", "/bench/arm");
export const confirmHome = (step: Axis, by: string) => call("post", "/bench/home", { step, by });
export const clearBench = () => call("post", "/bench/clear");
export const reset = () => call("post", "/reset");
export const step = (ticks: number) => call("post", "/step", { ticks });
/** kept: lanes and effects that the figure by itself has not. */
export const runFigure = (
  figure: Figure,
  law: Law,
  kept: { rivals?: Configuration["rivals"]; effects?: EffectsRequest },
) => send("post", "/experiment", { figure, law, load: true, ...kept });
export const addLoad = (load: Load) => call("post", "/loads", load);
export const removeLoad = (id: number) =>
  request("delete", `${SESSION}/loads/${id}`) as Promise<SessionState>;
export const removeAllLoads = () => call("delete", "/loads");
export const takeControl = (by: string, takeOver: boolean) =>
  call("put", "/control", { by, take_over: takeOver });
export const giveControlBack = () => call("delete", "/control");
export const login = (secret: string) => request("post", "login", { secret });

export function streamAddress(rateHz: number, historyS: number, channels: readonly string[]): URL {
  const address = new URL(`${SESSION}/stream`, API);
  address.protocol = address.protocol.replace("http", "ws");
  address.searchParams.set("rate_hz", String(rateHz));
  address.searchParams.set("history_s", String(historyS));
  address.searchParams.set("lanes", "all");
  address.searchParams.set("channels", channels.join(","));
  address.searchParams.set("client", client);
  return address;
}
