/** The leaderboard: laws that were submitted, on a season that nobody knows. */
export const leaderboardText = {
  leaderboard: {
    title: "Leaderboard",
    lead: "Submit a law as a Python file and get a number that can be trusted: it goes through hidden trials drawn as those of the ranking.",
    season: (began: string, suite: string) => `This season began on ${began}, protocol ${suite}.`,
    loading: "The board is on its way …",
    empty: "No law has been submitted in this season yet",
    emptyHint:
      "Yours can be the first: paste it into the form or choose its file there, or use the command below it. Writing one takes a dozen lines; the form's example is a whole law to begin with.",
    entries: "Entries",
    table: "Rank, success rate, cost and worst run, a law a row",
    tableHint:
      "A press on a heading sorts by it, on a worst run shows it in 3D beside NDOBC. Rank is always by the success rate.",
    columns: {
      rank: { name: "Rank", hint: "By the share of trials that held; equal shares share a place" },
      law: {
        name: "Law",
        hint: "A law of the lab by its title, marked as a baseline; a submitted one as it was called, and by whom",
      },
      success: {
        name: "Held",
        hint: "Share of the season's hidden trials that held, with Wilson's 95 % interval: no fault, in the last second at most 1° and 10 % of σ_d, a peak of at most 30°",
      },
      ended: {
        name: "Ended",
        hint: "Hidden trials that ended in a fault or with an error of the law",
      },
      rms: { name: "rms, °", hint: "Median over the hidden trials of the rms position error" },
      cost: {
        name: "µs/tick",
        hint: "Median time of a tick by this machine's clock, with plant and sensors; of a submitted law also the way to its process and back, so compare it with other submitted ones only",
      },
      worst: {
        name: "Worst run",
        hint: "Of the public scenarios: the greatest rms error, or the first that ended early. The hidden trials are not shown",
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
    seeHint: (name: string) => `${name}: see this run in 3D beside NDOBC`,
    note: "Two laws had the same trials, so the difference between them is surer than their intervals. µs/tick compares entries of one kind only. Who submits often learns something of a season from the results.",
    submit: "Submit a law",
    submitHint: (runs: number) =>
      `${runs} runs in a process of its own that has nothing but its task: some minutes. The same text has one entry, which stays.`,
    name: "What it is called",
    author: "Who submits it (may be left empty)",
    law: "It defines law(time_s, reference, x, w), or build(model) that makes one, and answers with u1 and u2 in N·m. By name it may also take measured and applied.",
    send: "Submit",
    example: "Begin with an example",
    known: (name: string | undefined) =>
      name === undefined
        ? "This text has its entry already."
        : `This text has its entry already, and keeps it: ${name}.`,
    measuring: (title: string) => `Measuring: ${title}`,
    measured: (title: string) => `Measured: ${title}`,
    labFollows: "It has its entry; now the lab's own laws are measured on the same season.",
    runs: (done: number, total: number) => `${done} of ${total || "…"} runs`,
    failed: "It did not get onto the board.",
    failedHint: "Mend it, and submit it again: nothing was kept.",
    notIsolated: "This lab takes no law: it cannot be isolated on this machine.",
    observer: "Who only watches does not submit: join as a student to.",
    lab: "The lab's own laws",
    missing: (count: number) =>
      count === 1
        ? "One of them is not measured in this season yet."
        : `${count} of them are not measured in this season yet. A submission measures them after it.`,
    measureLab: "Measure them now",
    script: "With a command",
    scriptHint: "The same on the machine that the lab runs on, or at home for practice:",
    command: "svsa ranking submit law.py\nsvsa ranking submit law.py --practice",
    back: "Leaderboard",
    unknown: "There is no such entry in this season.",
    worstOf: (name: string) => `Worst run of ${name}`,
    standing: (rank: number, success: string) => `rank ${rank}, ${success} of the trials held`,
    beside: (law: string, isInstalled: boolean) =>
      `Worst of the public scenarios, beside ${law} on the same; the season's hidden trials are not shown. ${
        isInstalled
          ? "Simulated again for this view."
          : "The law does not run again: its torques were kept when it was measured."
      }`,
  },
};
