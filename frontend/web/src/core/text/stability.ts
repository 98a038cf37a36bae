/** Stability margins of a design, and its response to disturbances. */
export const stabilityText = {
  stability: {
    title: "Stability margins",
    slowest: "Slowest pole",
    slowestHint:
      "Largest real part of the closed-loop poles at rest, in continuous time, with the true plant and the observer; stable below 0",
    rate: (value: string) => `${value} rad/s`,
    damping: "Smallest damping ratio",
    dampingHint: "Smallest −Re s / |s| of these poles: 1 without oscillation",
    gain: "Error per unit load rate",
    gainHint:
      "Error of the linear loop under a link torque that increases by 1 N·m/s; a constant torque causes none",
    l1: "… L1 gain",
    l1Hint:
      "Largest error of the linear loop under any torque on the link that changes by at most 1 N·m each second, for small motions. Theorem 1 is local: this is no ISS gain of the nonlinear loop",
    gainValue: (degrees: string) => `${degrees}° per N·m/s`,
    noGain: "not rejected",
    floor: "… at least",
    floorHint: "Lower bound with these poles, for any observer bandwidth",
    fastest: (sensing: string) => `Fastest observer, ${sensing}`,
    fastestHint:
      "The largest β with which the sampled loop is stable, with its delay and its estimated velocities",
    anyObserver: "over 1000 rad/s",
    fastestLine: (value: string) => `β < ${value}`,
    sensing: { session: "here", rig: "on the rig" },
    ranges: "Stable parameter range",
    rangesHint:
      "Ratio of the true to the nominal value of one parameter, all others exact, for which every pole is stable; searched from 0.05 to 20",
    parameter: "True / nominal",
    range: "stable",
    now: "now",
    times: (symbol: string) => `${symbol} ×`,
    between: (low: string, high: string) => `${low} – ${high}`,
    upTo: (high: string) => `up to ${high}`,
    from: (low: string) => `from ${low}`,
    all: "all",
    unstableAsItIs: "Unstable even with an exact model.",
    margins: (sensing: string) => `Margins of the sampled loop, ${sensing}`,
    noMargins: (sensing: string) => `The sampled loop is unstable, ${sensing}: no margins.`,
    modulus: "Modulus margin",
    modulusHint: "1/‖S‖∞ of the sampled loop, opened at both torques: 1 at best, 0 at instability",
    delay: "Delay margin",
    delayHint:
      "Additional delay of both torques, of which the observer is not informed, that makes the loop unstable",
    milliseconds: (value: string) => `${value} ms`,
    anyDelay: "any delay",
    gain1: "Gain margin of u1",
    gain2: "Gain margin of u2",
    gainMarginHint: "Range of the gain factor on this torque for which the loop is stable",
    joint: "Joint model error",
    jointHint:
      "The smallest error of M, B1, B2 and Ks together that a search found to make the loop unstable: root of the sum of squares, and the four errors, true over nominal",
    jointValue: (norm: string, errors: string) => `${norm} (${errors})`,
    noJoint: "none found",
    switching: "This law switches at rest: the margins are those of the averaged loop.",
    loadTitle: "Response to 3 kg, from rest",
    bodeTitle: "Torque on the link → error",
    time: "s",
    frequency: "Hz",
    error: "error, °",
    magnitude: "° per N·m",
    loadSummary: (peak: string, fault: string | null) =>
      `Position error after the 3 kg load: up to ${peak}°${fault ? `; fault: ${fault}` : ""}`,
    loadFault: (fault: string) => `The run ends in a fault. ${fault}`,
    bodeSummary: (most: string, isUnstable: boolean) =>
      isUnstable
        ? "No frequency response: the loop is unstable"
        : `Error for a sine of 1 N·m on the link, over frequency: up to ${most}°`,
    bodeUnstable: "unstable: no steady state",
    unstableOn: {
      rig: {
        short: "unstable on the rig",
        summary: (pole: string) =>
          `On the rig this loop is unstable (largest pole |z| = ${pole}). The curves show the loop without the rig's quantization and delay.`,
      },
      session: {
        short: "unstable: no steady state",
        summary: (pole: string) =>
          `The loop with these settings is unstable (largest pole |z| = ${pole}): a small error keeps growing.`,
      },
    },
    caveat: (summary: string, short: string) => `${summary}; ${short}`,
    lineStyles: (name: string, short: string | null) => (short ? `${name} (${short})` : name),
    tried: "these poles",
    inUse: "in use",
    region: "Region of attraction (sampled)",
    regionHint:
      "One simulation per initial state (q₀, q̇₀); counted as converged if |q| < 1° from 1.8 to 2 s",
    slice: "Slice",
    slices: { rigid: "φ₀ = 0, φ̇₀ = 0", deflected: "φ₀ ±0.3 rad, φ̇₀ ±5 rad/s" },
    regionCaption: (slice: string, starts: number) =>
      `Slice of the state space with ${slice}, ${starts} × ${starts} initial states within ±90° and ±20 rad/s. Samples, no proof for other states.`,
    regionAxes: "q̇₀ (rad/s) against q₀",
    regionStiffness: "Stiffness σ of the map, N·m/rad",
    law: "Law",
    fill: "Compute map",
    stop: "Stop",
    looks: { rest: "converged", fault: "fault", unsettled: "not within 2 s" },
    regionEmpty: "961 initial states, one simulation each.",
    regionSummary: (share: string, stiffness: string) =>
      `Map of initial states at σ = ${stiffness} N·m/rad: ${share} converge`,
    regionFound: (share: string, done: number, all: number, sensing: string, isOutdated: boolean) =>
      `${share} of ${done === all ? `${all} initial states` : `the ${done} initial states so far (of ${all})`} converge, ${sensing}${isOutdated ? "; computed for other poles" : ""}`,
    fail: "Run the failure in simulation",
    failHint:
      "A private simulated session with these gains and 3 kg after 1 s; this session is unchanged",
    failNote: "private, never on a bench",
  },
} as const;
