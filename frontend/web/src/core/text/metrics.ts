/** The metrics of a window of a run, as the server defines them (`svsa.runs.metrics.metrics.Metrics`). */

const recovery =
  "Time from the start of the window until the error has stayed within 2 % of its peak for 0.5 s. Later changes do not affect it.";
const rise = "Time in which the output goes from 10 % to 90 % of the step of the reference";
const overshoot =
  "Largest excess over the new level until the output has settled, relative to the step";
const settling =
  "Time from the first change of the reference until the output has stayed within 2 % of the step around the new level for 0.5 s. The fade of the reference is part of it.";

export const metricsText = {
  all: "All metrics",
  allHint: "Position, stiffness and effort of every lane in this window",
  metric: "Metric",
  groups: { position: "Position", stiffness: "Stiffness", effort: "Effort" },
  both: "u₁ / u₂",
  tiny: "< 10⁻⁶",
  units: {
    degrees: "deg",
    degreeSeconds: "deg·s",
    stiffness: "N·m/rad",
    stiffnessSeconds: "N·m·s/rad",
    seconds: "s",
    percent: "%",
    torque: "N·m",
    variation: "N·m/s",
    work: "J",
    effort: "N²·m²·s",
  },
  rms: { name: "rms error", hint: "Root mean square over the window" },
  peak: { name: "Peak deviation", hint: "Largest absolute error in the window" },
  peakShare: {
    name: "Peak deviation, relative",
    hint: "Largest absolute stiffness error in the window, relative to the reference",
  },
  steady: {
    name: "Steady-state error",
    hint: "rms error over the last 0.5 s of the window",
  },
  iae: { name: "IAE", hint: "Integral of the absolute error over the window" },
  recovery: { name: "Recovery time", hint: recovery },
  rise: { name: "Rise time", hint: rise },
  overshoot: { name: "Overshoot", hint: overshoot },
  settling: { name: "Settling time", hint: settling },
  rmsTorque: { name: "rms torque", hint: "Root mean square of the actual torque over the window" },
  peakTorque: { name: "Peak torque", hint: "Largest absolute value of the actual torque" },
  effort: {
    name: "Control effort",
    hint: "∫(u₁² + u₂²) dt; the heat of each motor’s windings follows its term",
  },
  work: {
    name: "Mechanical work",
    hint: "∫(|u₁ θ̇₁| + |u₂ θ̇₂|) dt, without energy recovery. The losses of the windings are not included, because their resistance is not known.",
  },
  variation: { name: "Total variation", hint: "Σ|Δu| per second: a measure of chattering" },
  noise: {
    name: "Torque noise at rest",
    hint: "Standard deviation of the torque over the last 0.5 s of the window",
  },
  /** Why a metric is not defined. */
  undefined: {
    lane: "This lane has no numbers in the window.",
    tooShort: "Not defined: the window is shorter than 1 s.",
    loadEnded: "Not defined: the load ended within the window.",
    undisturbed: "Not defined: no load was added or removed at the start of the window.",
    outside: "Not yet: the error has not stayed within 2 % of its peak for 0.5 s.",
    unmoved: "Not defined: the stiffness error never exceeded 0.01 N·m/rad.",
    lost: "Recovered after {{seconds}} s, but the steady-state error is above 2 % of the peak: the load changes.",
    unreached: "Not yet: the output has not reached 90 % of the step.",
    unsettled: "Not yet: the output has not stayed within 2 % of the step for 0.5 s.",
    moving:
      "Not defined: the window is shorter than 0.5 s, or in its last 0.5 s a reference changed or the link moved by more than 0.1°.",
  },
} as const;
