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
      "Theorem 1: what a torque on the link that grows by 1 N·m each second leaves of error; nothing stays where it does not change",
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
      "Simulated from each place: link and motor 1 begin at q0 with q̇0 as one body, and are to stand within 1° of zero after 2 s",
    regionAxes: "q0; up: q̇0, rad/s",
    regionStiffness: "Stiffness σ of the map, N·m/rad",
    law: "Law",
    fill: "Fill the map",
    stop: "Stop",
    looks: { rest: "comes to rest", fault: "fault", astray: "not within 2 s" },
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
