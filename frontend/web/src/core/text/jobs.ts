/** Long work on the server: how it stands, and what is asked of it. */
export const jobsText = {
  jobs: {
    status: {
      waiting: "waits for another one",
      running: "running",
      done: "done",
      cancelled: "cancelled; what is done is kept",
      failed: "failed",
    },
    rate: (rate: number) =>
      `${rate < 10 ? rate.toFixed(1) : Math.round(rate).toLocaleString("en")} runs/s`,
    compiling: "compiling …",
    left: (time: string) => `${time} left`,
    cancel: "Cancel",
    cancelHint: "Stop after the runs that are being worked at; what is done is kept",
  },
};

/** Tuning a law. */
export const tuningText = {
  tuning: {
    title: "Tune a law",
    open: "Tune …",
    openHint: "Search this law's parameters on five training runs",
    about:
      "Sobol points all over the parameters, then Nelder–Mead from the best, on five training runs with the rig's effects that stand in no table: pulses, sines, a mass, models that are off by half, friction and noise.",
    cost: "cost = rms error, ° + 0.1 rms stiffness error, N·m/rad + 0.3 rms torque change a tick, N·m; a fault costs 6 to 12",
    law: "Law",
    budget: "Candidates",
    budgetHint: "1 to 2000; half of them are Sobol points",
    start: "Start",
    stop: "Stop",
    stopHint: "Keeps the best so far",
    status: {
      waiting: "Waits for its turn.",
      running: "Searching.",
      done: "Done.",
      cancelled: "Stopped; this is the best so far.",
      failed: "It failed.",
    },
    progress: (law: string, tried: number, budget: number) =>
      `${law}: ${Math.max(0, tried - 1)} of ${budget} candidates`,
    first: "The first runs compile the law; that takes a few seconds.",
    curve: "Best cost",
    curveSummary: (first: string, best: string, tried: number) =>
      `Best cost over ${tried} candidates: from ${first} down to ${best}`,
    best: "best so far",
    each: "each candidate",
    candidates: "candidates",
    costAxis: "cost",
    values: "Parameters, before and best",
    runs: "Training runs, before and with the best",
    parameter: "Parameter",
    before: "before",
    tuned: "best",
    range: "searched",
    run: "Training run",
    runCost: "cost",
    runError: "error, °",
    runStiffness: "σ error",
    runTorqueChange: "shake",
    runHint: "rms error, rms stiffness error in N·m/rad, rms torque change a tick in N·m",
    mean: "mean",
    fault: "fault",
    arrow: (before: string, after: string) => `${before} → ${after}`,
    use: "Use these",
    useHint: "Sets this session to the best parameters of the law",
    used: "This session is set to them.",
    notBetter: "Nothing better than what was set has been found.",
    otherLaw: (law: string) => `${law} does not control here now; they are kept for when it does.`,
    save: "Save as file",
    saveHint: "A parameter file (TOML) that says what it was measured on",
  },
} as const;
