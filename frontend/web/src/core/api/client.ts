/** The public REST API, one function per call. The page uses no other interface of the server. */
import { ChangedError, RefusedError, UnansweredError } from "./errors";
import { learnOutcome } from "./outcome";
import { API, client, LONGEST_WAIT_MS, request, sessionName } from "./request";
import type {
  ActuatorParameters,
  Axis,
  Body,
  Configuration,
  EffectsRequest,
  Figure,
  Kinds,
  Lane,
  Law,
  LawRow,
  Load,
  Method,
  PositionReference,
  Sent,
  SessionPath,
  SessionState,
  Speed,
  StiffnessReference,
} from "./types";

const SESSION = `sessions/${encodeURIComponent(sessionName)}`;
const LONGEST_STOP_MS = 1500;

const SETTINGS =
  /^\/(position|stiffness|law|gains|parameters|observer|actuator|nominal|effects|lanes)(\/|$)/;
const takesRevision = (method: Method, path: string): boolean =>
  (method === "put" || method === "patch") && SETTINGS.test(path);

let seen: string | null = null;

/** What this page has set last, by the path below the session, as the server answered. */
const set = new Map<string, SessionState>();
export const lastSet = (path: string): SessionState | null => set.get(path) ?? null;

/** The revision of the state that the next setting was chosen for; another refuses it. */
export function expectRevision(revision: string | null): void {
  seen = revision;
}

async function sendSetting(method: Method, path: string, body: unknown): Promise<SessionState> {
  const match = seen === null ? {} : { "If-Match": `"${seen}"` };
  try {
    const state = (await request(
      method,
      SESSION + path,
      body,
      LONGEST_WAIT_MS,
      match,
    )) as SessionState;
    seen = state.revision;
    set.set(path, state);
    return state;
  } catch (error) {
    const isOld = error instanceof RefusedError && error.status === 412;
    throw isOld ? new ChangedError(error.message, path) : error;
  }
}

/** Where no answer comes, the server is asked outcome of it, and for its state. */
async function send(method: Method, path: string, body?: unknown): Promise<SessionState> {
  try {
    if (takesRevision(method, path)) return await sendSetting(method, path, body);
    return (await request(method, SESSION + path, body)) as SessionState;
  } catch (error) {
    if (!(error instanceof UnansweredError) || error.request === null) throw error;
    await learnOutcome(error);
    return readState();
  }
}

/** One call on the session; path and body are checked against the server's schema. */
function call<M extends Method, P extends SessionPath>(method: M, path: P, ...body: Body<M, P>) {
  return send(method, path, body[0]);
}

export type GainsRequest = Body<"put", "/gains">[0];

export const readState = () => call("get", "");
export const putPosition = (reference: Sent<PositionReference>) =>
  call("put", "/position", reference);
export const putStiffness = (reference: Sent<StiffnessReference>) =>
  call("put", "/stiffness", reference);
/** Begins the one that is followed again, faded over. */
export const repeatPosition = async () => {
  const { configuration } = await readState();
  return send("put", "/position?restart=true", configuration.position);
};
export const repeatStiffness = async () => {
  const { configuration } = await readState();
  return send("put", "/stiffness?restart=true", configuration.stiffness);
};
/** comparisons: laws of the comparison lanes in order; lanes left out keep their laws. */
export const putLaw = (law: Law, comparisons: readonly Law[]) =>
  call(
    "put",
    "/law",
    comparisons.length === 0 ? { law } : { law, comparison_laws: [...comparisons] },
  );
export const putGains = (gains: GainsRequest) => call("put", "/gains", gains);
/** By the law's name; what is left out stays. */
export const putParameters = (parameters: Body<"put", "/parameters">[0]) =>
  call("put", "/parameters", parameters);
export const readFaults = () => readKinds().then(({ faults }) => faults);
export const readLaws = () => request("get", "laws") as Promise<LawRow[]>;
export const putObserver = (link: number, motor1: number, motor2: number) =>
  call("put", "/observer", { bandwidth_rad_per_s: [link, motor1, motor2] });
export const putLanes = (comparisons: readonly Lane[]) =>
  call("put", "/lanes", { comparisons: [...comparisons] });
/** lane: its number, from 2 on; its plant stays where it is. */
export const putLane = (lane: number, controller: Lane) =>
  send("put", `/lanes/${lane}`, controller);
export const readKinds = () => request("get", "kinds") as Promise<Kinds>;
export const putEffects = (effects: EffectsRequest) => send("put", "/effects", effects);
/** patch: parameters by name; the session's actuator checks them. */
export const patchActuator = (patch: ActuatorParameters) => send("patch", "/actuator", patch);
export const patchNominal = (patch: ActuatorParameters) => send("patch", "/nominal", patch);
export const putNominal = (toml: string) => call("put", "/nominal", { toml });
export const excite = (name: string) => call("post", "/excitation", { name });
export const stopExcitation = () => call("delete", "/excitation");
/** The run is named after its settings until a user renames it. */
export const startRecording = () => call("post", "/recording", { name: "", tags: [], notes: "" });
export const stopRecording = () => call("delete", "/recording");
export const putSpeed = (speed: Speed) => call("put", "/speed", { speed });
export const start = () => call("post", "/start");
export const pause = () => call("post", "/pause");
export const stopAtOnce = () =>
  request("post", `${SESSION}/quick-stop`, undefined, LONGEST_STOP_MS) as Promise<SessionState>;
/** Without the lab's secret: stopping is open to all. */
export const stopWithoutLogin = () => request("post", "quick-stop", undefined, LONGEST_STOP_MS);
export const armBench = () => call("post", "/bench/arm");
export const confirmHome = (step: Axis, by: string) => call("post", "/bench/home", { step, by });
export const clearBench = () => call("post", "/bench/clear");
export const restartBench = () => call("post", "/bench/restart");
export const reset = () => call("post", "/reset");
export const step = (ticks: number) => call("post", "/step", { ticks });
/** kept: lanes and effects that the figure itself does not define. */
export const runFigure = (
  figure: Figure,
  law: Law,
  kept: { comparisons?: Configuration["comparisons"]; effects?: EffectsRequest },
) => send("post", "/experiment", { figure, law, load: true, ...kept });
export const addLoad = async (load: Load) => {
  await send("post", "/loads", load);
  return readState();
};
export const removeLoad = (id: number) => send("delete", `/loads/${id}`);
export const removeAllLoads = () => call("delete", "/loads");
export const takeControl = (by: string, takeOver: boolean) =>
  call("put", "/control", { by, take_over: takeOver });
export const giveControlBack = () => call("delete", "/control");
/** Passes control to a user in the queue; for the holder and the instructor. */
export const handControlOver = (to: string) => call("post", "/control/handover", { to });
export const lockControl = (locked: boolean) => call("put", "/control/lock", { locked });

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
