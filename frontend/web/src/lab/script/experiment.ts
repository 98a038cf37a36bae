/** A run as a Python file that does it again in a private session, every change at its own tick.
 * It imports nothing of the browser: tests of the client bundle it alone and run it with Node. */

import type { CommandKind, RunOrigin } from "../../core/api/types";
import { buildValue, type Fields, inDocstring, toPython, toRows } from "./snippets";

const INDENT = "        ";
const SETTINGS = ["position", "stiffness", "gains", "observer", "effects", "comparisons"] as const;
const MODELS = ["actuator", "nominal"] as const;

const isSame = (one: unknown, other: unknown) => JSON.stringify(one) === JSON.stringify(other);

/** Without what stands at null, which the library knows as its default. */
function prune(value: unknown): unknown {
  if (Array.isArray(value)) return value.map(prune);
  if (value === null || typeof value !== "object") return value;
  const entries = Object.entries(value).filter(([, inner]) => inner !== null);
  return Object.fromEntries(entries.map(([key, inner]) => [key, prune(inner)]));
}

const pruned = (value: unknown) => prune(value) as Fields;

/** A value with a `kind`: "minimum_jerk" of Position is svsa.MinimumJerkPosition. */
function buildKind(value: unknown, of: string): string {
  const { kind, ...fields } = pruned(value);
  const words = String(kind).split("_");
  const name = words.map((word) => word.charAt(0).toUpperCase() + word.slice(1)).join("");
  return buildValue(`svsa.${name}${of}`, fields, INDENT);
}

const buildLane = (lane: unknown) => buildValue("svsa.Lane", pruned(lane), INDENT);

const assign = (field: string, value: string): string[] => [`session.${field} = ${value}`];
const assignKind = (of: string) => (argument: unknown, field: string) =>
  assign(field, buildKind(argument, of));
const assignValue = (type: string) => (argument: unknown, field: string) =>
  assign(field, buildValue(`svsa.${type}`, pruned(argument), INDENT));
const assignModel = (argument: unknown, field: string) =>
  assign(field, buildValue(`session.${field}.changed`, pruned(argument), INDENT));

type Write = (argument: unknown, kind: CommandKind) => string[];

/** How the library says each kind of command. */
const WRITE: Record<CommandKind, Write> = {
  position: assignKind("Position"),
  stiffness: assignKind("Stiffness"),
  gains: assignValue("Gains"),
  observer: assignValue("ObserverBandwidth"),
  effects: assignValue("Effects"),
  actuator: assignModel,
  nominal: assignModel,
  law: (law) => assign("law", toPython(law)),
  laws: (laws) => [`session.set_laws(${(laws as unknown[]).map(toPython).join(", ")})`],
  comparisons: (lanes) =>
    assign("comparisons", `[${(lanes as unknown[]).map(buildLane).join(", ")}]`),
  lane: (argument) => {
    const { lane, setting } = argument as { lane: number; setting: unknown };
    return [`session.set_lane(${lane}, ${buildLane(setting)})`];
  },
  parameters: (laws) =>
    Object.entries(pruned(laws)).map(([law, values]) =>
      toRows(`session.set_parameters(${toPython(law)}, `, values as Fields, INDENT),
    ),
  load: (load) => [`session.loads.add(${buildKind(load, "Load")})`],
  unload: (number) => [`session.loads.remove(${String(number)})`],
  stop: () => ["# Here the bench was stopped; a simulation has no ramp to zero torque."],
};

/** The lines of Python that give a command again. */
export const writeCommand = (kind: CommandKind, argument: unknown): string[] =>
  WRITE[kind](argument, kind);

/** What of the settings of a run a new private session has not. */
function writeSettings({ configuration, defaults }: RunOrigin): string[] {
  const lines: string[] = [];
  for (const kind of SETTINGS) {
    if (!isSame(configuration[kind], defaults[kind]))
      lines.push(...writeCommand(kind, configuration[kind]));
  }
  for (const kind of MODELS) {
    const known = defaults[kind] as Fields;
    const changes = Object.entries(configuration[kind] as Fields).filter(
      ([key, value]) => !isSame(value, known[key]),
    );
    if (changes.length > 0) lines.push(...writeCommand(kind, Object.fromEntries(changes)));
  }
  if (!isSame(configuration.parameters, defaults.parameters))
    lines.push(...writeCommand("parameters", configuration.parameters));
  return lines;
}

function writeChanges({ configuration, commands, ...origin }: RunOrigin): string[] {
  const { first_tick: first, period_s: periodS } = origin;
  const loads = configuration.loads as unknown[];
  const lines = loads.flatMap((load) => writeCommand("load", load));
  const followed: Fields = { position: configuration.position, stiffness: configuration.stiffness };
  let reached = 0;
  const runTo = (tick: number, remark = "") => {
    if (tick > reached) lines.push(`session.run_until(${secondsOf(tick, periodS)})${remark}`);
    reached = Math.max(reached, tick);
  };
  const begin = () => runTo(first, "  # Here the recording begins.");
  for (const { tick, command } of commands) {
    const { kind, argument } = command;
    if (tick >= first) begin();
    runTo(tick);
    // A reference that is followed already is not set again by its assignment.
    const isRepeated = kind in followed && isSame(followed[kind], argument);
    lines.push(...(isRepeated ? [`session.repeat_${kind}()`] : writeCommand(kind, argument)));
    if (kind in followed) followed[kind] = argument;
  }
  begin();
  return lines;
}

const secondsOf = (tick: number, periodS: number): string =>
  String(Number((tick * periodS).toFixed(6)));

/** `title` is said in the docstring; `lab` is the address of the lab, without a slash at its end. */
export function writeExperiment(origin: RunOrigin, title: string, lab: string): string {
  const { configuration, defaults } = origin;
  const [begin, end] = [origin.first_tick, origin.tick].map((tick) =>
    secondsOf(tick, origin.period_s),
  );
  const before =
    origin.first_tick === 0
      ? ""
      : ` The recording begins at ${begin} s; the time before
it is simulated too.`;
  const law = toPython(configuration.law);
  const seed = isSame(configuration.seed, defaults.seed)
    ? ""
    : `, "seed": ${toPython(configuration.seed)}`;
  const lines = [
    "session.pause()",
    ...writeSettings(origin),
    "session.reset()",
    ...writeChanges(origin),
    `session.run_until(${end})`,
  ];
  return `"""${inDocstring(title)}: an experiment of SVSA Lab, 0 to ${end} s, to be run again.${before}

It needs the library (pip install 'svsa-lab[client]') and a running lab; with a secret or the token
of a class, set SVSA_SECRET. It uses a private session, so it affects no other user, and runs as fast as it
goes; every change comes at its time. With --shared it works in the lab's shared session, a
simulation or a bench that is armed and at home: it asks for control, and waits for its turn.
"""

import argparse
import sys

import svsa

reader = argparse.ArgumentParser(description=__doc__)
reader.add_argument("lab", nargs="?", default=${toPython(lab)})
reader.add_argument("--shared", action="store_true", help="in the lab's shared session")
asked = reader.parse_args()

settings = {"law": ${law}, "load": False${seed}}
try:
    with svsa.connect(asked.lab) as lab, lab.experiment(asked.shared, **settings) as session:
${lines.map((line) => INDENT + line).join("\n")}
        state = session.read_state()
except svsa.SvsaError as error:
    sys.exit(f"The experiment ended early: {error}")

since = state["window"]["start_s"]
for lane in state["lanes"]:
    metrics = lane["in_window"]
    rms = metrics["rms_position_error_rad"] if metrics else 0.0
    print(f"{lane['name']}: rms position error {rms:.3e} rad since {since:.3f} s")
print(f"reached {state['time_s']:.3f} s")
`;
}
