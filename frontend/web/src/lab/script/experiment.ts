/**
 * A run as a Python file that repeats it in a private session, every change at its own tick. It has
 * no browser dependencies: tests of the client bundle it alone and run it with Node.
 */

import type { CommandKind, RunOrigin } from "../../core/api/types";
import { findChanges, isEqual } from "../../core/state/changes";
import { changeArm, INDENT, writeCommand } from "./commands";
import { type Fields, inDocstring, toPython } from "./snippets";

const SETTINGS = [
  ...["law", "position", "stiffness", "gains", "observer", "spring", "effects", "comparisons"],
];
const MODELS = ["actuator", "nominal"] as const;
const ARM_FIELDS = ["feedforward", "adaptation", "tip", "links", "model"];
/** Commands that are of no joint, unless they name one. */
const OF_SESSION = ["comparisons", "feedforward", "adaptation", "load", "unload", "stop"];

/** A joint of an arm, or the only one. */
interface Joint {
  /** Its name in the script. */
  on: string;
  configuration: Fields;
  /** Its configuration in a new session. */
  defaults: Fields;
}

const armOf = (configuration: Fields) =>
  configuration.arm as (Fields & { other_joints: Fields[] }) | null;

/** The joints; a session opens with the law of joint 1, whose comparisons are first set for all. */
function listJoints({ configuration, ...origin }: RunOrigin): Joint[] {
  const { law, comparisons } = configuration;
  const [arm, plain] = [armOf(configuration), armOf(origin.defaults)];
  const defaults = { ...origin.defaults, law };
  if (!arm?.other_joints.length || !plain) return [{ on: "session", configuration, defaults }];
  const others = arm.other_joints.map((joint, index) => ({
    on: `joint${index + 2}`,
    configuration: joint,
    defaults: { ...plain.other_joints[index], law, comparisons },
  }));
  return [{ on: "joint1", configuration, defaults }, ...others];
}

/** Settings of a joint that a new session lacks. */
function writeJoint({ on, configuration, defaults }: Joint): string[] {
  const changes = findChanges(configuration, defaults, SETTINGS);
  for (const kind of MODELS) {
    const fields = findChanges(configuration[kind] as Fields, defaults[kind] as Fields);
    if (Object.keys(fields).length > 0) changes[kind] = fields;
  }
  Object.assign(changes, findChanges(configuration, defaults, ["parameters"]));
  return Object.entries(changes).flatMap(([kind, argument]) =>
    writeCommand(kind as CommandKind, argument, on),
  );
}

function writeArm({ configuration, defaults }: RunOrigin): string[] {
  const [arm, plain] = [armOf(configuration), armOf(defaults)];
  const changes = arm && plain ? findChanges(arm, plain, ARM_FIELDS) : {};
  return Object.keys(changes).length > 0 ? changeArm(changes) : [];
}

function writeChanges({ commands, ...origin }: RunOrigin, joints: readonly Joint[]): string[] {
  const { first_tick: first, period_s: periodS } = origin;
  const lines = joints.flatMap(({ on, configuration }) =>
    (configuration.loads as unknown[]).flatMap((load) => writeCommand("load", load, on)),
  );
  const followed = new Map(
    joints.map(({ on, configuration: { position, stiffness } }) => [
      on,
      { position, stiffness } as Fields,
    ]),
  );
  let reached = 0;
  const runTo = (tick: number, remark = "") => {
    if (tick > reached) lines.push(`session.run_until(${secondsOf(tick, periodS)})${remark}`);
    reached = Math.max(reached, tick);
  };
  const begin = () => runTo(first, "  # Here the recording begins.");
  for (const { tick, command } of commands) {
    const { kind, argument, joint = null } = command;
    if (tick >= first) begin();
    runTo(tick);
    const isOfAll = joint === null && !OF_SESSION.includes(kind);
    const named = joints.filter(({ on }) => isOfAll || on === `joint${joint}`);
    for (const { on } of named.length > 0 ? named : [{ on: "session" }]) {
      // An assignment would not restart a reference that is already followed.
      const held = followed.get(on);
      const isRepeated = held && kind in held && isEqual(held[kind], argument);
      lines.push(...(isRepeated ? [`${on}.repeat_${kind}()`] : writeCommand(kind, argument, on)));
      if (held && kind in held) held[kind] = argument;
    }
  }
  begin();
  return lines;
}

/** Names of the joints of an arm in the script. */
function openJoints(joints: readonly Joint[]): string[] {
  if (joints.length < 2) return [];
  const numbers = joints.map((_, index) => index + 1).join(", ");
  return [`${joints.map(({ on }) => on).join(", ")} = map(session.open_joint, (${numbers}))`];
}

const secondsOf = (tick: number, periodS: number): string =>
  String(Number((tick * periodS).toFixed(6)));

/** The parts of the script that open its session; loops other than the SVSA's compile first. */
function writeOpening({ opening, configuration, defaults }: RunOrigin) {
  const { from, ...request } = opening;
  const settings: Fields = { ...request, law: configuration.law };
  if (!isEqual(configuration.seed, defaults.seed)) settings.seed = configuration.seed;
  const head = `settings = ${toPython(settings)}`;
  if (from !== "figure") {
    const address = "asked.lab, timeout_s=120.0";
    return { hint: "", option: "", head, address, call: "new_session(**settings)" };
  }
  return {
    hint: ` With --shared it works in the lab's shared session, a
simulation or a bench that is armed and at home: it asks for control, and waits for its turn.`,
    option: `
reader.add_argument("--shared", action="store_true", help="in the lab's shared session")`,
    head,
    address: "asked.lab",
    call: "experiment(asked.shared, **settings)",
  };
}

/** `title` is for the docstring; `lab` is the address of the lab, without a slash at its end. */
export function writeExperiment(origin: RunOrigin, title: string, lab: string): string {
  const [begin, end] = [origin.first_tick, origin.tick].map((tick) =>
    secondsOf(tick, origin.period_s),
  );
  const before =
    origin.first_tick === 0
      ? ""
      : ` The recording begins at ${begin} s; the time before
it is simulated too.`;
  const { hint, option, head, address, call } = writeOpening(origin);
  const joints = listJoints(origin);
  const lines = [
    ...openJoints(joints),
    "session.pause()",
    ...joints.flatMap(writeJoint),
    ...writeArm(origin),
    "session.reset()",
    ...writeChanges(origin, joints),
    `session.run_until(${end})`,
  ];
  return `"""${inDocstring(title)}: an experiment of SVSA Lab, 0 to ${end} s, to be run again.${before}

It needs the library (pip install 'svsa-lab[client]') and a running lab; with a secret or the token
of a class, set SVSA_SECRET. It uses a private session, so it affects no other user, and runs as fast as it
goes; every change comes at its time.${hint}
"""

import argparse
import sys

import svsa

reader = argparse.ArgumentParser(description=__doc__)
reader.add_argument("lab", nargs="?", default=${toPython(lab)})${option}
asked = reader.parse_args()

${head}
try:
    with svsa.connect(${address}) as lab, lab.${call} as session:
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
