/** Commands of a run as lines of Python, on the session or on a joint of an arm. */

import type { CommandKind } from "../../core/api/types";
import { buildValue, type Fields, toPython, toRows } from "./snippets";

export const INDENT = "        ";

/** Without null values, which are the defaults of the library. */
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

/** Loads on the tip of an arm have no suffix: "tip_mass" is svsa.TipMass. */
const buildLoad = (load: unknown) =>
  buildKind(load, /^(tip_|wall$)/.test(String((load as Fields).kind)) ? "" : "Load");

type Write = (argument: unknown, on: string, kind: CommandKind) => string[];

const assign = (on: string, field: string, value: string): string[] => [
  `${on}.${field} = ${value}`,
];
const assignKind =
  (of: string): Write =>
  (argument, on, field) =>
    assign(on, field, buildKind(argument, of));
const assignValue =
  (type: string): Write =>
  (argument, on, field) =>
    assign(on, field, buildValue(`svsa.${type}`, pruned(argument), INDENT));
const assignModel: Write = (argument, on, field) => {
  const { mechanism: _, ...fields } = pruned(argument);
  return assign(on, field, buildValue(`${on}.${field}.changed`, fields, INDENT));
};

/** The change of fields of the arm; a null value takes adaptation or tip reference away. */
export function changeArm(fields: Fields): string[] {
  const values = Object.entries(fields).map(([name, value]) => [name, prune(value)]);
  return [toRows("session.change_arm(", Object.fromEntries(values), INDENT)];
}

/** Python form of each kind of command. */
const WRITE: Record<CommandKind, Write> = {
  position: assignKind("Position"),
  stiffness: assignKind("Stiffness"),
  gains: assignValue("Gains"),
  observer: assignValue("ObserverBandwidth"),
  spring: assignValue("SpringEstimation"),
  effects: assignValue("Effects"),
  actuator: assignModel,
  nominal: assignModel,
  law: (law, on) => assign(on, "law", toPython(law)),
  laws: (laws, on) => [`${on}.set_laws(${(laws as unknown[]).map(toPython).join(", ")})`],
  comparisons: (lanes, on) =>
    /^joint[^1]/.test(on)
      ? (lanes as unknown[]).map((lane, index) => setLane(on, index + 2, lane))
      : assign("session", "comparisons", `[${(lanes as unknown[]).map(buildLane).join(", ")}]`),
  lane: (argument, on) => {
    const { lane, setting } = argument as { lane: number; setting: unknown };
    return [setLane(on, lane, setting)];
  },
  parameters: (laws, on) =>
    Object.entries(pruned(laws)).map(([law, values]) =>
      toRows(`${on}.set_parameters(${toPython(law)}, `, values as Fields, INDENT),
    ),
  feedforward: (feedforward) => changeArm({ feedforward }),
  adaptation: (adaptation) => changeArm({ adaptation }),
  load: (load, on) => [`${on}.loads.add(${buildLoad(load)})`],
  unload: (number) => [`session.loads.remove(${String(number)})`],
  stop: () => ["# Here the bench was stopped; a simulation has no ramp to zero torque."],
};

const setLane = (on: string, lane: number, setting: unknown): string =>
  `${on}.set_lane(${lane}, ${buildLane(setting)})`;

/** The lines of Python that repeat a command. on: the session, or its joint, in the script. */
export const writeCommand = (kind: CommandKind, argument: unknown, on = "session"): string[] =>
  WRITE[kind](argument, on, kind);
