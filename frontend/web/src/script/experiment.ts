/** A run as a Python file that does it again in a private session, every change at its own tick. */
import type { CommandKind, RunOrigin } from "../api/types";
import { callInPython, inDocstring, toPython } from "./python";

type Values = Record<string, unknown>;
type Step = { method: "PUT" | "POST" | "PATCH" | "DELETE"; path: string; body?: unknown };

const IN_TRY = "    ";
const SETTINGS = ["position", "stiffness", "gains", "parameters", "observer"] as const;
const MODELS = ["actuator", "nominal"] as const;

const isSame = (one: unknown, other: unknown) => JSON.stringify(one) === JSON.stringify(other);

/** Without what stands at null, which a request may leave out. */
function prune(value: unknown): unknown {
  if (Array.isArray(value)) return value.map(prune);
  if (value === null || typeof value !== "object") return value;
  const entries = Object.entries(value).filter(([, inner]) => inner !== null);
  return Object.fromEntries(entries.map(([key, inner]) => [key, prune(inner)]));
}

function differences(wanted: Values, known: Values): Values {
  return Object.fromEntries(
    Object.entries(wanted).filter(([key, value]) => !isSame(value, known[key])),
  );
}

/** The public call that gives a command again. */
export function stepOf(kind: CommandKind, argument: unknown): Step {
  switch (kind) {
    case "law":
      return { method: "PUT", path: "/law", body: { law: argument } };
    case "laws": {
      const [law, ...rivals] = argument as unknown[];
      return { method: "PUT", path: "/law", body: { law, rival_laws: rivals } };
    }
    case "rivals":
      return { method: "PUT", path: "/lanes", body: { rivals: prune(argument) } };
    case "lane": {
      const { lane, setting } = argument as { lane: number; setting: unknown };
      return { method: "PUT", path: `/lanes/${lane}`, body: prune(setting) };
    }
    case "actuator":
    case "nominal":
      return { method: "PATCH", path: `/${kind}`, body: argument };
    case "load":
      return { method: "POST", path: "/loads", body: prune(argument) };
    case "unload":
      return { method: "DELETE", path: `/loads/${String(argument)}` };
    default:
      return { method: "PUT", path: `/${kind}`, body: prune(argument) };
  }
}

function writeStep({ method, path, body }: Step): string {
  const head = `call("${method}", ${toPython(path)}`;
  if (body === undefined) return `${IN_TRY}${head})`;
  return callInPython(`${head}, `, body, IN_TRY);
}

/** What a new private session is asked for: all that cannot be changed later, and the lanes. */
function writeCreation({ configuration, defaults }: RunOrigin): string {
  const keys = ["rivals", "effects", "seed"].filter(
    (key) => !isSame(configuration[key], defaults[key]),
  );
  const wanted = Object.fromEntries(keys.map((key) => [key, configuration[key]]));
  const body = { figure: "4a", law: configuration.law, load: false, ...wanted };
  return callInPython('call("POST", "/sessions", ', prune(body));
}

function writeSettings({ configuration, defaults }: RunOrigin): string[] {
  const steps: Step[] = [];
  for (const kind of SETTINGS) {
    if (!isSame(configuration[kind], defaults[kind])) steps.push(stepOf(kind, configuration[kind]));
  }
  for (const kind of MODELS) {
    const changes = differences(configuration[kind] as Values, defaults[kind] as Values);
    if (Object.keys(changes).length > 0) steps.push(stepOf(kind, changes));
  }
  return steps.map(writeStep);
}

function writeChanges({ configuration, commands, period_s: periodS }: RunOrigin): string[] {
  const loads = configuration.loads as unknown[];
  const lines = loads.map((load) => writeStep(stepOf("load", load)));
  let reached = 0;
  for (const { tick, command } of commands) {
    if (tick > reached) lines.push(writeRun(tick, periodS));
    reached = Math.max(reached, tick);
    lines.push(writeStep(stepOf(command.kind, command.argument)));
  }
  return lines;
}

const secondsOf = (tick: number, periodS: number): string =>
  String(Number((tick * periodS).toFixed(6)));

const writeRun = (tick: number, periodS: number): string =>
  `${IN_TRY}run_until(${secondsOf(tick, periodS)})`;

/** `title` is said in the docstring; `lab` is the address of the lab, without a slash at its end. */
export function writeExperiment(origin: RunOrigin, title: string, lab: string): string {
  const end = secondsOf(origin.tick, origin.period_s);
  return `"""${inDocstring(title)}: an experiment of SVSA Lab, 0 to ${end} s, to be run again.

It needs httpx (pip install httpx) and a running lab; with a secret, set SVSA_SECRET. It works in
a private session, so it disturbs nobody, and as fast as it goes; every change comes at its time.
"""

import os
import sys

import httpx

LAB = sys.argv[1] if len(sys.argv) > 1 else ${toPython(lab)}
SECRET = os.environ.get("SVSA_SECRET")

lab = httpx.Client(
    base_url=f"{LAB}/api/v1",
    headers={"Authorization": f"Bearer {SECRET}"} if SECRET else None,
    timeout=60,
)
session = ""


def call(method, path, body=None):
    """One call, on the private session once there is one; ends where the lab refuses."""
    answer = lab.request(method, session + path, json=body)
    if answer.is_error:
        sys.exit(f"{method} {path} was refused: {answer.text}")
    return answer.json() if answer.content else None


def run_until(time_s):
    """Go on to this session time."""
    state = call("GET", "")
    end = round(time_s * state["rate_hz"])
    while state["tick"] < end:
        if state["fault"]:
            sys.exit(f"Stopped at {state['time_s']:.3f} s: {state['fault']['message']}")
        state = call("POST", "/step", {"ticks": min(10_000, end - state["tick"])})
    return state


created = ${writeCreation(origin)}
session = f"/sessions/{created['session']}"
try:
    call("POST", "/pause")
${[...writeSettings(origin), `${IN_TRY}call("POST", "/reset")`, ...writeChanges(origin)].join("\n")}
    state = run_until(${end})
    since = state["window"]["start_s"]
    for lane in state["lanes"]:
        metrics = lane["in_window"]
        error = metrics["rms_position_error_rad"] if metrics else 0.0
        print(f"{lane['name']}: rms position error {error:.3e} rad since {since:.3f} s")
    print(f"reached {state['time_s']:.3f} s")
finally:
    lab.delete(session)
`;
}
