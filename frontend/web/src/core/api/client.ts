/** The public REST API, one function per call. The page uses no other interface of the server. */

import type { ArmPatch } from "./arm";
import { ChangedError, RefusedError, UnansweredError } from "./errors";
import {
  call,
  type Edit,
  fillPath,
  type OperationOf,
  type Parts,
  parametersOf,
  type TakesEdit,
  type Template,
} from "./operations";
import { awaitOutcome } from "./outcome";
import { API, client, sessionName, WORK_TIMEOUT_MS } from "./request";
import type {
  ActuatorParameters,
  Axis,
  Configuration,
  EffectsRequest,
  Figure,
  Joint,
  Lane,
  Law,
  LawRow,
  Load,
  Method,
  PositionReference,
  RequestOf,
  SessionState,
  Speed,
  StiffnessReference,
} from "./types";

const SESSION = `sessions/${encodeURIComponent(sessionName)}`;
const STOP_TIMEOUT_MS = 1500;

/** Opens a private session, of an arm if one is named; returns its name. */
export const openPrivateSession = async (arm = "") => {
  const body = arm === "" ? {} : { from: "arm" as const, arm };
  return (await call("post", "/sessions", { body }, WORK_TIMEOUT_MS)).session;
};

/** Values that this page has set last, by path below the session, as the server confirmed them. */
const confirmedStates = new Map<string, SessionState>();
export const lastConfirmed = (path: string): SessionState | null =>
  confirmedStates.get(path) ?? null;

type Prefix = "/sessions/{session}";
type Below<M extends Method> =
  Template<M> extends infer T ? (T extends `${Prefix}${infer Rest}` ? Rest : never) : never;
type InSession<M extends Method, P extends Below<M>> = OperationOf<
  M,
  `${Prefix}${P}` & Template<M>
>;
type BodyOf<M extends Method, P extends Below<M>> =
  Parts<InSession<M, P>> extends { body: infer B } ? B : never;

/** A request of the session, which is sent with an edit if it takes a joint or a revision. */
export type SessionRequest = (edit: Edit) => Promise<SessionState>;
type RequestFor<O> =
  TakesEdit<O> extends true ? SessionRequest : (edit?: Edit) => Promise<SessionState>;

/**
 * Build a request of the session. If no answer comes, its outcome and the state are queried. path:
 * below the session.
 */
function inSession<M extends Method, P extends Below<M> & string>(
  method: M,
  path: P,
  parts: Parts<InSession<M, P>>,
): RequestFor<InSession<M, P>> {
  const template = `/sessions/{session}${path}`;
  const setting = fillPath(path, (parts as { path?: object }).path);
  return async (edit?: Edit) => {
    const isSetting = edit && parametersOf(method, template).parameters.includes("if-match");
    try {
      const state = (await call(
        method,
        template as never,
        { ...(parts as object), edit } as never,
      )) as SessionState;
      if (isSetting) {
        edit.base.revision = state.revision;
        confirmedStates.set(setting, state);
      }
      return state;
    } catch (error) {
      if (isSetting && error instanceof RefusedError && error.status === 412) {
        throw new ChangedError(error.message, setting);
      }
      if (!(error instanceof UnansweredError) || error.request === null) throw error;
      await awaitOutcome(error);
      return readState();
    }
  };
}

export type GainsRequest = BodyOf<"put", "/gains">;

export const readHealth = () => call("get", "/health", {});
export const readState = () => call("get", "/sessions/{session}", {});
export const putPosition = (body: RequestOf<PositionReference>) =>
  inSession("put", "/position", { body });
export const putSpring = (body: Configuration["spring"]) => inSession("put", "/spring", { body });
export const putStiffness = (body: RequestOf<StiffnessReference>) =>
  inSession("put", "/stiffness", { body });
/** Restart the current reference with a fade; of all joints each its own. */
const repeatReference =
  (name: "position" | "stiffness"): SessionRequest =>
  async (edit) => {
    const state = await readState();
    const { configuration } = state;
    const { arm } = configuration;
    const restart = (of: Pick<Configuration, typeof name>, joint: Joint | null) =>
      inSession("put", `/${name}`, { query: { restart: true }, body: of[name] })(
        edit.forJoint(joint),
      );
    if (!arm) return restart(configuration, edit.joint);
    let after = state;
    for (const [index, of] of [configuration, ...arm.other_joints].entries()) {
      const joint = index + 1;
      if (edit.joint === null || edit.joint === joint) after = await restart(of, joint);
    }
    return after;
  };

export const repeatPosition = repeatReference("position");
export const repeatStiffness = repeatReference("stiffness");
/** comparisons: laws of the comparison lanes in order; lanes that are left out keep their laws. */
export const putLaw = (law: Law, comparisons: readonly Law[]) =>
  inSession("put", "/law", {
    body: comparisons.length === 0 ? { law } : { law, comparison_laws: comparisons },
  });
export const putGains = (gains: GainsRequest) => inSession("put", "/gains", { body: gains });
/** Parameters by law name; those that are left out keep their values. */
export const putParameters = (parameters: BodyOf<"put", "/parameters">) =>
  inSession("put", "/parameters", { body: parameters });
export const readLaws = () => call("get", "/laws", {}) as Promise<LawRow[]>;
export const putObserver = (link: number, motor1: number, motor2: number) =>
  inSession("put", "/observer", { body: { bandwidth_rad_per_s: [link, motor1, motor2] } });
export const putLanes = (comparisons: readonly Lane[]) =>
  inSession("put", "/lanes", { body: { comparisons } });
/**
 * lane: its number, from 2; its plant keeps its state. The page shows a comparison with the same
 * controller in both joints of an arm.
 */
export const putLane =
  (lane: number, body: Lane): SessionRequest =>
  (edit) =>
    inSession("put", "/lanes/{lane}", { path: { lane }, body })(edit.forJoint(null));
export const readKinds = () => call("get", "/kinds", {});
export const putEffects = (effects: EffectsRequest) =>
  inSession("put", "/effects", { body: effects });
/** patch: parameters by name; the session's actuator validates them. */
export const patchActuator = (patch: ActuatorParameters) =>
  inSession("patch", "/actuator", { body: patch });
export const patchNominal = (patch: ActuatorParameters) =>
  inSession("patch", "/nominal", { body: patch });
export const putNominal = (toml: string) => inSession("put", "/nominal", { body: { toml } });
export const startExcitation = (name: string) =>
  inSession("post", "/excitation", { body: { name } });
export const stopExcitation = inSession("delete", "/excitation", {});
/** The run is named after its settings until a user renames it. */
export const startRecording = inSession("post", "/recording", {
  body: { name: "", tags: [], notes: "" },
});
export const stopRecording = inSession("delete", "/recording", {});
export const putSpeed = (speed: Speed) => inSession("put", "/speed", { body: { speed } });
export const start = inSession("post", "/start", {});
export const pause = inSession("post", "/pause", {});
export const quickStop = () => call("post", "/sessions/{session}/quick-stop", {}, STOP_TIMEOUT_MS);
/** Needs no secret of the lab: every client may stop. */
export const quickStopWithoutLogin = () => call("post", "/quick-stop", {}, STOP_TIMEOUT_MS);
export const armBench = inSession("post", "/bench/arm", {});
export const confirmHome = (step: Axis, by: string) =>
  inSession("post", "/bench/home", { body: { step, by } });
export const clearBench = inSession("post", "/bench/clear", {});
export const restartBench = inSession("post", "/bench/restart", {});
export const reset = inSession("post", "/reset", {});
export const step = (ticks: number) => inSession("post", "/step", { body: { ticks } });
/** configuration: lanes and effects that the figure does not define. */
export const runFigure = (
  figure: Figure,
  law: Law,
  configuration: { comparisons?: Configuration["comparisons"]; effects?: EffectsRequest },
) => inSession("post", "/experiment", { body: { figure, law, load: true, ...configuration } });
/** Feedforward and adaptation act at once; links, model and the tip's reference restart the run. */
export const patchArm = (patch: ArmPatch) => inSession("patch", "/arm", { body: patch });
/** Only a torque acts on a joint: other loads are at the tip of an arm. */
export const addLoad =
  (load: Load): SessionRequest =>
  async (edit) => {
    const add = inSession("post", "/loads", { body: load });
    await add("torque_nm" in load ? edit : edit.forJoint(null));
    return readState();
  };
export const removeLoad = (id: number) =>
  inSession("delete", "/loads/{load_id}", { path: { load_id: id } });
export const removeAllLoads = inSession("delete", "/loads", {});
export const takeControl = (by: string, takeOver: boolean) =>
  inSession("put", "/control", { body: { by, take_over: takeOver } });
export const deleteControl = inSession("delete", "/control", {});
/** Pass control to a user in the queue; for the holder and the instructor. */
export const handControlOver = (to: string) =>
  inSession("post", "/control/handover", { body: { to } });
export const lockControl = (locked: boolean) =>
  inSession("put", "/control/lock", { body: { locked } });

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
