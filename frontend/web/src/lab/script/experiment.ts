/** A run as a Python file that does it again in a private session, every change at its own tick. */
import type { CommandKind, RunOrigin } from "../../core/api/types";
import { buildValue, type Fields, inDocstring, toPython, toRows } from "./python";

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

/** A value that is told apart by its kind: "minimum_jerk" of Position is svsa.MinimumJerkPosition. */
function buildKind(value: unknown, of: string): string {
  const { kind, ...fields } = pruned(value);
  const words = String(kind).split("_");
  const name = words.map((word) => word.charAt(0).toUpperCase() + word.slice(1)).join("");
  return buildValue(`svsa.${name}${of}`, fields, INDENT);
}

const buildLane = (lane: unknown) => buildValue("svsa.Lane", pruned(lane), INDENT);

/** The lines of Python that give a command again. */
export function writeCommand(kind: CommandKind, argument: unknown): string[] {
  switch (kind) {
    case "law":
      return [`session.law = ${toPython(argument)}`];
    case "laws":
      return [`session.set_laws(${(argument as unknown[]).map(toPython).join(", ")})`];
    case "lane": {
      const { lane, setting } = argument as { lane: number; setting: unknown };
      return [`session.set_lane(${lane}, ${buildLane(setting)})`];
    }
    case "comparisons":
      return [`session.comparisons = [${(argument as unknown[]).map(buildLane).join(", ")}]`];
    case "position":
      return [`session.position = ${buildKind(argument, "Position")}`];
    case "stiffness":
      return [`session.stiffness = ${buildKind(argument, "Stiffness")}`];
    case "gains":
      return [`session.gains = ${buildValue("svsa.Gains", pruned(argument), INDENT)}`];
    case "observer":
      return [
        `session.observer = ${buildValue("svsa.ObserverBandwidth", pruned(argument), INDENT)}`,
      ];
    case "effects":
      return [`session.effects = ${buildValue("svsa.Effects", pruned(argument), INDENT)}`];
    case "actuator":
    case "nominal":
      return [
        `session.${kind} = ${buildValue(`session.${kind}.changed`, pruned(argument), INDENT)}`,
      ];
    case "parameters":
      return Object.entries(pruned(argument)).map(([law, values]) =>
        toRows(`session.set_parameters(${toPython(law)}, `, values as Fields, INDENT),
      );
    case "load":
      return [`session.loads.add(${buildKind(argument, "Load")})`];
    case "unload":
      return [`session.loads.remove(${String(argument)})`];
    case "stop":
      return ["# Here the bench was stopped; a simulation has no ramp to zero torque."];
  }
}

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

function writeChanges({ configuration, commands, period_s: periodS }: RunOrigin): string[] {
  const loads = configuration.loads as unknown[];
  const lines = loads.flatMap((load) => writeCommand("load", load));
  let reached = 0;
  for (const { tick, command } of commands) {
    if (tick > reached) lines.push(`session.run_until(${secondsOf(tick, periodS)})`);
    reached = Math.max(reached, tick);
    lines.push(...writeCommand(command.kind, command.argument));
  }
  return lines;
}

const secondsOf = (tick: number, periodS: number): string =>
  String(Number((tick * periodS).toFixed(6)));

/** `title` is said in the docstring; `lab` is the address of the lab, without a slash at its end. */
export function writeExperiment(origin: RunOrigin, title: string, lab: string): string {
  const { configuration, defaults } = origin;
  const end = secondsOf(origin.tick, origin.period_s);
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
  return `"""${inDocstring(title)}: an experiment of SVSA Lab, 0 to ${end} s, to be run again.

It needs the library (pip install 'svsa-lab[client]') and a running lab; with a secret or the token
of a class, set SVSA_SECRET. It works in a private session, so it disturbs nobody, and as fast as it
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
