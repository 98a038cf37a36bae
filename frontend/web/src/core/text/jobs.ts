/** Jobs on the server: state, progress and commands. */
export const jobsText = {
  jobs: {
    status: {
      waiting: "queued",
      running: "running",
      done: "done",
      cancelled: "cancelled; completed runs are kept",
      failed: "failed",
      interrupted: "interrupted; completed runs are kept",
    },
    rate: "{{rate}} runs/s",
    compiling: "compiling …",
    left: "{{time}} left",
    cancel: "Cancel",
    cancelHint: "Stop after the runs in progress; completed runs are kept",
    example: "Example",
    exampleHint: "A finished result that comes with the lab; your first result replaces it",
  },
} as const;

/** Forms of requests. */
export const formsText = {
  forms: {
    kind: "Kind",
    item: "Item",
    none: "none",
    add: "Add {{item, lowercase}}",
    remove: "Remove",
    removeItem: "Remove {{item, lowercase}} {{number}}",
  },
} as const;

/** Tuning a law. */
export const tuningText = {
  tuning: {
    title: "Tune a law",
    open: "Tune …",
    openHint: "Search this law's parameters on training trials",
    about:
      "CMA-ES from the current parameters on 128 training trials, then the ten best candidates on 512 validation trials. Loads, models, stiffness and noise are sampled as for the test trials of the ranking, which are separate.",
    cost: "cost = mean over the trials of log10(rms error, °) + log10(relative rms stiffness error) + 2 if not held; 3 to 4 for a fault; 5 and more above the noise limit",
    start: "Start",
    stop: "Stop",
    stopHint: "Keeps the best result so far",
    status: {
      waiting: "Queued.",
      running: "Searching.",
      done: "Done.",
      cancelled: "Stopped; best result so far.",
      failed: "Failed.",
      interrupted: "Interrupted; best result so far.",
    },
    progress: "{{law}}: {{tried}} of {{budget}} candidates",
    first: "Compiling the law takes a few seconds.",
    curve: "Best cost",
    curveSummary: "Best cost over {{tried}} candidates: from {{first}} down to {{best}}",
    best: "best so far",
    each: "each candidate",
    candidates: "candidates",
    costAxis: "cost",
    values: "Parameters, before and best",
    results: "Results, before and best",
    onValidation: "On the validation trials",
    onTraining: "On the training trials",
    resultHeads: ["values", "cost", "held", "rms error, °", "stiffness error, %", "noise, N·m/s"],
    held: "{{held}} of {{trials}}",
    tooNoisy: "too noisy",
    noiseLimit:
      "Noise: total variation of u1 at rest, at most {{limit}} N·m/s, that of NDOBC with the declared gains.",
    parameter: "Parameter",
    before: "before",
    tuned: "best",
    range: "searched",
    use: "Apply best",
    useHint: "Applies the best parameters of the law to this session",
    used: "Applied to this session.",
    notBetter: "No better parameters than the current ones were found.",
    otherLaw: "The parameters take effect when {{law}} controls this session.",
    save: "Save as file",
    saveHint: "A parameter file (TOML) with its measured results",
  },
} as const;
