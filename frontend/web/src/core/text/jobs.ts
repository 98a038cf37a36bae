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
    openHint: "Search this law's parameters on training trials",
    about:
      "CMA-ES from the present parameters on 128 training trials, then the ten best candidates on 512 validation trials. Loads, models, stiffness and noise are drawn as for the ranking's test trials, which are others.",
    cost: "cost = mean over the trials of log10(rms error, °) + log10(rms stiffness error over σ_d) + 2 if not held; 3 to 4 for a fault; 5 and more above the noise limit",
    law: "Law",
    budget: "Candidates",
    budgetHint: "1 to 2000",
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
    results: "Results, before and best",
    onValidation: "On the validation trials",
    onTraining: "On the training trials",
    resultHeads: ["values", "cost", "held", "error, °", "σ error, %", "noise, N·m/s"],
    held: (held: number, trials: number) => `${held} of ${trials}`,
    tooNoisy: "too noisy",
    noiseLimit: (limit: string) =>
      `Noise: total variation of u1 at rest, at most ${limit} N·m/s, that of NDOBC with the declared gains.`,
    parameter: "Parameter",
    before: "before",
    tuned: "best",
    range: "searched",
    use: "Use these",
    useHint: "Sets this session to the best parameters of the law",
    used: "This session is set to them.",
    notBetter: "Nothing better than what was set has been found.",
    otherLaw: (law: string) => `${law} does not control here now; they are kept for when it does.`,
    save: "Save as file",
    saveHint: "A parameter file (TOML) that says what it was measured on",
  },
} as const;
