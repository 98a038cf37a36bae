/** The leaderboard: laws that were submitted, on a season that nobody knows. */
export const leaderboardText = {
  leaderboard: {
    title: "Leaderboard",
    lead: "Submit a law as a Python file and get a number that can be trusted: it goes through the ranking's scored runs, on trials that nobody knows.",
    season: (began: string, suite: string) => `This season began on ${began}, suite ${suite}.`,
    loading: "The board is on its way …",
    empty: "No law has been submitted in this season yet",
    emptyHint:
      "Yours can be the first: paste it into the form or choose its file there, or use the command below it. Writing one takes a dozen lines; the form's example is a whole law to begin with.",
    entries: "Entries",
    table: "Rank, score and its parts, cost and worst run, a law a row",
    tableHint:
      "A press on a heading sorts by it, on a worst run shows it in 3D beside NDOBC. Rank is always by score.",
    columns: {
      rank: { name: "Rank", hint: "By score; equal scores share a place" },
      law: {
        name: "Law",
        hint: "A law of the lab by its title, marked as a baseline; a submitted one as it was called, and by whom",
      },
      score: {
        name: "Score",
        hint: "0.5 robustness + 0.3 trials that held + 0.2 accuracy, from 0 to 1; below it the 95 % interval",
      },
      robustness: { name: "Robust", hint: "Mean share of runs that held in the six sweeps" },
      trials: {
        name: "Trials",
        hint: "Share of the season's hidden trials that held: no fault, and at most 1° rms in the last second",
      },
      accuracy: {
        name: "Accuracy",
        hint: "Mean of 1 − tanh(rms / 1°) over the 13 scenarios that everybody knows, 0 for a fault",
      },
      cost: {
        name: "µs/tick",
        hint: "Median time of a tick by this machine's clock, with plant and sensors; of a submitted law also the way to its process and back, so compare it with other submitted ones only",
      },
      worst: {
        name: "Worst run",
        hint: "Of the 13 scenarios that everybody knows: the greatest rms error, or the first that ended early. The hidden trials are not shown",
      },
      entered: { name: "Measured", hint: "When, in your time" },
    },
    weights: { robustness: "0.5 robustness", trials: "0.3 trials", accuracy: "0.2 accuracy" },
    intervalKey: "95 % by the trials",
    interval: (low: string, high: string) => `${low}–${high}`,
    intervalHint:
      "The score with the share of trials at the ends of its 95 % interval (Wilson); it says nothing of the other parts",
    by: (author: string) => `by ${author}`,
    submittedLaw: "submitted",
    baseline: "baseline",
    baselineHint: "A law of the lab, compiled, as it is by default",
    notMeasured: "not measured in this season yet",
    trialsHeld: (held: number, of: number) => `${held} of ${of} held`,
    measuredWith: (when: string, version: string) => `${when}, with SVSA Lab ${version}`,
    ended: "ended early",
    degrees: (error: string) => `${error}°`,
    rms: (error: string) => `${error}° rms`,
    see: (name: string) => `${name}, worst run in 3D:`,
    seeHint: (name: string) => `${name}: see this run in 3D beside NDOBC`,
    note: "Two laws had the same trials, so the difference between them is surer than their intervals. µs/tick compares entries of one kind only. Who submits often learns something of a season from the scores.",
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
    standing: (rank: number, score: string) => `rank ${rank}, score ${score}`,
    beside: (law: string, isInstalled: boolean) =>
      `Worst of the 13 scenarios that everybody knows, beside ${law} on the same; the season's hidden trials are not shown. ${
        isInstalled
          ? "Simulated again for this view."
          : "The law does not run again: its torques were kept when it was measured."
      }`,
  },
};
