/** The leaderboard: submitted laws on the hidden trials of a season. */
export const leaderboardText = {
  leaderboard: {
    title: "Leaderboard",
    lead: "Submit a control law as a Python file. It runs on hidden trials that are sampled like those of the ranking.",
    season: (began: string, suite: string) => `This season began on ${began}, protocol ${suite}.`,
    loading: "Loading the leaderboard …",
    empty: "No law has been submitted in this season yet",
    emptyHint:
      "Paste a law into the form, choose a file, or use the command below. A law needs about twelve lines; the form contains a complete example.",
    published: "Published ranking",
    publishedHint:
      "The season begins with the first submission or measurement; its entries then replace this table. The published trials are not those of the season.",
    entries: "Entries",
    table: "Rank, success rate, cost and worst run: one row per law",
    tableHint:
      "Select a heading to sort by it, or a worst run to see it in 3D, compared with NDOBC. The rank is always by success rate.",
    columns: {
      rank: {
        name: "Rank",
        hint: "By the share of trials that held; equal shares have equal rank",
      },
      law: {
        name: "Law",
        hint: "Title of an installed law (marked baseline), or name and author of a submitted one",
      },
      success: {
        name: "Trials held",
        hint: "Share of the season's hidden trials that held, with Wilson's 95 % interval: no fault, in the last second at most 1° and 10 % of the stiffness reference, a peak of at most 30°",
      },
      ended: {
        name: "Ended early",
        hint: "Hidden trials that ended in a fault or with an error of the law",
      },
      rms: {
        name: "Median rms error, °",
        hint: "Median over the hidden trials of the rms position error",
      },
      cost: {
        name: "Time per tick, µs",
        hint: "Median time of a tick by this machine's clock, with plant and sensors. For a submitted law it includes the communication with its process: compare submitted laws with each other only",
      },
      worst: {
        name: "Worst run",
        hint: "Of the public scenarios: the largest rms error, or the first that ended early. The hidden trials are not shown",
      },
      entered: { name: "Measured", hint: "When, in your time" },
    },
    percent: (share: number) => `${(100 * share).toFixed(1)} %`,
    interval: (low: string, high: string) => `${low}–${high}`,
    intervalHint: "95 % interval of the success rate (Wilson)",
    by: (author: string) => `by ${author}`,
    submittedLaw: "submitted",
    baseline: "baseline",
    baselineHint: "A law of the lab, compiled, with the parameters of the ranking",
    notMeasured: "not measured in this season yet",
    trialsHeld: (held: number, of: number) => `${held} of ${of} held`,
    measuredWith: (when: string, version: string) => `${when}, with SVSA Lab ${version}`,
    ended: "ended early",
    degrees: (error: string) => `${error}°`,
    rms: (error: string) => `${error}° rms`,
    see: (name: string) => `${name}, worst run in 3D:`,
    seeHint: (name: string) => `${name}: see this run in 3D, compared with NDOBC`,
    note: "All laws run on the same trials, so a difference between two laws is more certain than their intervals suggest. Compare the time per tick within one kind of entry only. Repeated submissions reveal something about a season's trials.",
    submit: "Submit a law",
    submitHint: (runs: number) =>
      `${runs} runs in an isolated process; takes some minutes. The same text has one permanent entry.`,
    name: "Name of the law",
    author: "Author (optional)",
    law: "Defines law(time_s, reference, x, w), or build(model) that returns one; returns u1 and u2 in N·m. The parameters measured and applied are optional.",
    send: "Submit",
    example: "Insert an example",
    known: (name: string | undefined) =>
      name === undefined
        ? "This text already has an entry."
        : `This text already has an entry: ${name}.`,
    measuring: (title: string) => `Measuring: ${title}`,
    measured: (title: string) => `Measured: ${title}`,
    labFollows: "The entry is saved. The installed laws are now measured on the same season.",
    runs: (done: number, total: number) => `${done} of ${total || "…"} runs`,
    failed: "The submission failed.",
    failedHint: "Fix the law and submit it again: no entry was saved.",
    notIsolated: "Submission is disabled: this machine cannot isolate submitted laws.",
    observer: "Observers cannot submit: join as a student.",
    lab: "Installed laws",
    missing: (count: number) =>
      count === 1
        ? "One installed law is not measured in this season yet."
        : `${count} installed laws are not measured in this season yet. They are measured after the next submission.`,
    measureLab: "Measure them now",
    script: "From the command line",
    scriptHint: "On the machine that runs the lab, or at home for practice:",
    command: "svsa ranking submit law.py\nsvsa ranking submit law.py --practice",
    back: "Leaderboard",
    unknown: "Entry not found in this season.",
    worstOf: (name: string) => `Worst run of ${name}`,
    standing: (rank: number, success: string) => `rank ${rank}, ${success} of the trials held`,
    comparison: (law: string, isInstalled: boolean) =>
      `Worst of the public scenarios, compared with ${law} on the same one; the season's hidden trials are not shown. ${
        isInstalled
          ? "Simulated again for this view."
          : "The law does not run again: the torques recorded at the measurement are replayed."
      }`,
  },
};
