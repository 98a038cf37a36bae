/** The plots of several lanes side by side: one quantity a plot, one ink a lane. */
import { text } from "../text/en";
import { FRAMES, type PlotChoice, type PlotDefinition, type Trace } from "./definitions";
import { inkOf } from "./inks";

const { plots } = text;
const DOTTED: readonly number[] = [2, 4];

const lanesOf = (channel: string, names: readonly string[]): Trace[] =>
  names.map((label, index) => ({
    key: `${channel}.${index + 1}`,
    channel,
    lane: index + 1,
    label,
    ...inkOf(index + 1),
  }));

const dotted = (channel: string, label: string, lane = 1): Trace => ({
  key: `${channel}.${lane}`,
  channel,
  lane,
  label,
  colour: "reference",
  dash: DOTTED,
  width: 1.5,
});

/** A load may depend on where its lane is: a curve a lane, which lie on each other if it does not. */
const truth = (channel: string, names: readonly string[]): Trace[] =>
  names.map((_, index) => ({
    ...dotted(channel, plots.true, index + 1),
    ...(index > 0 ? { follows: `${channel}.1` } : {}),
  }));

export function comparePlots(names: readonly string[]): readonly PlotDefinition[] {
  const one = (...traces: Trace[][]): PlotChoice[] => [{ label: "", traces: traces.flat() }];
  const torque = (label: string, channel: "torque1_nm" | "torque2_nm"): PlotChoice => ({
    label,
    traces: lanesOf(channel, names),
    bounds: ({ configuration: { limits } }) => [
      { label: plots.limit(label), value: limits[channel], colour: "reference" },
    ],
  });
  const load = (label: string, name: string): PlotChoice => ({
    label,
    traces: [...lanesOf(`estimate_${name}_nm`, names), ...truth(`disturbance_${name}_nm`, names)],
  });
  return [
    {
      ...FRAMES.position,
      title: plots.position,
      choices: one(lanesOf("position_rad", names), [
        dotted("position_reference_rad", plots.reference),
      ]),
    },
    {
      ...FRAMES.error,
      title: plots.error,
      choices: one(lanesOf("position_error_rad", names)),
    },
    {
      ...FRAMES.stiffness,
      title: plots.stiffness,
      choices: one(lanesOf("stiffness_nm_per_rad", names), [
        dotted("stiffness_reference_nm_per_rad", plots.reference),
      ]),
    },
    {
      ...FRAMES.torque,
      title: plots.torque,
      choices: [torque(plots.torque1, "torque1_nm"), torque(plots.torque2, "torque2_nm")],
    },
    {
      ...FRAMES.disturbance,
      title: plots.disturbance,
      choices: [
        load(plots.link, "link"),
        load(plots.motor1Short, "motor1"),
        load(plots.motor2Short, "motor2"),
      ],
    },
  ];
}
