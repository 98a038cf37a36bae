/** The plots of one lane by itself: which channels are drawn where. */
import { text } from "../text/en";
import { DASHED, FRAMES, PLAIN, type PlotDefinition, type Trace } from "./definitions";

const { plots } = text;

type Ink = Pick<Trace, "colour" | "width">;

const plain = (channel: string, label: string, ink: Ink): Trace => ({
  key: channel,
  channel,
  lane: 1,
  label,
  dash: PLAIN,
  ...ink,
});
const reference = (channel: string): Trace => ({
  ...plain(channel, plots.reference, { colour: "reference", width: 1.5 }),
  dash: DASHED,
});
const estimate = (name: string, label: string, ink: Ink): Trace =>
  plain(`estimate_${name}_nm`, label, ink);
const truth = (name: string, { colour, label }: Trace): Trace => ({
  ...plain(`disturbance_${name}_nm`, label, { colour, width: 1.5 }),
  dash: DASHED,
  follows: `estimate_${name}_nm`,
});

const link = estimate("link", plots.link, { colour: "vermilion", width: 3 });
const motor1 = estimate("motor1", plots.motor1, { colour: "blue", width: 2 });
const motor2 = estimate("motor2", plots.motor2, { colour: "purple", width: 1 });

const one = (...traces: Trace[]) => [{ label: "", traces }];

export const PLOTS_ALONE: readonly PlotDefinition[] = [
  {
    ...FRAMES.position,
    title: plots.position,
    choices: one(
      plain("position_rad", plots.measured, { colour: "blue", width: 3 }),
      reference("position_reference_rad"),
    ),
  },
  {
    ...FRAMES.error,
    title: plots.error,
    choices: one(plain("position_error_rad", plots.errorTrace, { colour: "vermilion", width: 2 })),
  },
  {
    ...FRAMES.stiffness,
    title: plots.stiffness,
    choices: one(
      plain("stiffness_nm_per_rad", plots.measured, { colour: "green", width: 3 }),
      reference("stiffness_reference_nm_per_rad"),
    ),
  },
  {
    ...FRAMES.torque,
    title: plots.torque,
    choices: [
      {
        label: "",
        traces: [
          plain("torque1_nm", plots.torque1, { colour: "blue", width: 1.75 }),
          plain("torque2_nm", plots.torque2, { colour: "orange", width: 1.75 }),
        ],
        bounds: ({ configuration: { limits } }) => [
          { label: plots.limit(plots.torque1), value: limits.torque1_nm, colour: "blue" },
          { label: plots.limit(plots.torque2), value: limits.torque2_nm, colour: "orange" },
        ],
      },
    ],
  },
  {
    ...FRAMES.disturbance,
    title: plots.disturbance,
    note: plots.disturbanceNote,
    choices: one(
      link,
      motor1,
      motor2,
      truth("link", link),
      truth("motor1", motor1),
      truth("motor2", motor2),
    ),
  },
];
