/** How stable a design is, and what disturbances do to it. */
export const stabilityText = {
  stability: {
    title: "How stable",
    slowest: "Slowest pole",
    slowestHint:
      "Largest real part of the closed loop about rest, in continuous time, with the true plant and the observer; stable below 0",
    rate: (value: string) => `${value} rad/s`,
    damping: "Least damping",
    dampingHint: "Least −Re s / |s| of these poles: 1 without oscillation",
    gain: "Error per ẇ",
    gainHint:
      "Error of the linear loop under a torque on the link that grows by 1 N·m each second; a constant torque leaves none",
    l1: "… L1 gain",
    l1Hint:
      "Largest error of the linear loop under any torque on the link that changes by at most 1 N·m each second, for small motions. Theorem 1 is local: this is no ISS gain of the nonlinear loop",
    gainValue: (degrees: string) => `${degrees}° per N·m/s`,
    noGain: "w itself stays",
    floor: "… at least",
    floorHint: "What no observer, however fast, goes below with these poles",
    fastest: (sensing: string) => `Fastest observer, ${sensing}`,
    fastestHint:
      "The largest β with which the sampled loop is stable, with its delay and its estimated velocities",
    anyObserver: "over 1000 rad/s",
    fastestLine: (value: string) => `β < ${value}`,
    sensing: { session: "here", rig: "on the rig" },
    ranges: "Stays stable for",
    rangesHint:
      "True value of one parameter over the nominal one, all others exact, in which every pole stays left of the axis; looked for from 0.05 to 20",
    parameter: "True / nominal",
    range: "stable",
    now: "now",
    times: (symbol: string) => `${symbol} ×`,
    between: (low: string, high: string) => `${low} – ${high}`,
    upTo: (high: string) => `up to ${high}`,
    from: (low: string) => `from ${low}`,
    all: "all",
    unstableAsItIs: "Not stable even where the model is exact.",
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
    gainMarginHint: "Factors on this torque between which the loop stays stable",
    joint: "Joint model error",
    jointHint:
      "The smallest error of M, B1, B2 and Ks together that a search found to make the loop unstable: root of the sum of squares, and the four errors, true over nominal",
    jointValue: (norm: string, errors: string) => `${norm} (${errors})`,
    noJoint: "none found",
    switching: "This law switches at rest: the margins are of an average.",
    loadTitle: "3 kg come at rest",
    bodeTitle: "Torque on the link → error",
    time: "s",
    frequency: "Hz",
    error: "error, °",
    magnitude: "° per N·m",
    loadSummary: (peak: string, fault: string | null) =>
      `Position error after the 3 kg come: up to ${peak}°${fault ? `; it ends in a fault: ${fault}` : ""}`,
    loadFault: (fault: string) => `It ends in a fault. ${fault}`,
    bodeSummary: (most: string, isUnstable: boolean) =>
      isUnstable
        ? "No frequency response: the loop is unstable"
        : `Error for a sine of 1 N·m on the link, over frequency: up to ${most}°`,
    bodeUnstable: "unstable: nothing settles",
    unstableOn: {
      rig: {
        short: "unstable on the rig",
        summary: (pole: string) =>
          `On the rig this loop is unstable (largest pole |z| = ${pole}). The curves are of the loop as it is simulated here, without the encoders' counts and delay: there it would do none of this.`,
      },
      session: {
        short: "unstable: does not come to rest",
        summary: (pole: string) =>
          `The loop as it is set here is unstable (largest pole |z| = ${pole}): what looks calm at first goes on growing.`,
      },
    },
    caveat: (summary: string, short: string) => `${summary}; ${short}`,
    lineStyles: (name: string, short: string | null) => (short ? `${name} (${short})` : name),
    tried: "these poles",
    inUse: "in use",
    region: "Comes to rest from",
    regionHint:
      "Simulated from each start: the link begins at q0 with q̇0, and has come to rest if it is within 1° of zero from 1.8 to 2 s",
    slice: "Slice",
    slices: { rigid: "φ0 = 0, φ̇0 = 0", deflected: "φ0 ±0.3 rad, φ̇0 ±5 rad/s" },
    regionCaption: (slice: string, starts: number) =>
      `A slice of the state space with ${slice}, ${starts} × ${starts} starts within ±90° and ±20 rad/s. A sample, no proof for any other start.`,
    regionAxes: "q0; up: q̇0, rad/s",
    regionStiffness: "Stiffness σ of the map, N·m/rad",
    law: "Law",
    fill: "Fill the map",
    stop: "Stop",
    looks: { rest: "comes to rest", fault: "fault", unsettled: "not within 2 s" },
    regionEmpty: "961 starts, simulated one after another.",
    regionSummary: (share: string, stiffness: string) =>
      `Map of starts at σ = ${stiffness} N·m/rad: ${share} come to rest`,
    regionFound: (share: string, done: number, all: number, sensing: string, isOutdated: boolean) =>
      `${share} of ${done === all ? `${all} starts` : `the ${done} starts so far (of ${all})`} come to rest, ${sensing}${isOutdated ? "; of other poles than these" : ""}`,
    fail: "Fail it in simulation",
    failHint:
      "A private simulated session with these gains, in which the 3 kg come after 1 s; this session stays as it is",
    failNote: "private, never on a bench",
  },
} as const;
