/** The ranking: every law in the same scenarios. */
const sweeps: Record<string, string> = {
  model: "Model",
  velocity_noise: "Noise",
  torque_noise: "Torque noise",
  torque_response: "Torque lag",
  delay: "Delay",
  perturbation: "Pushes",
};

export const rankingText = {
  ranking: {
    title: "Ranking",
    lead: "Every law on the same plant, torque limits, noise and loads. Press a number to see its run in the lab, beside NDOBC unless that ends first; press a law to lay it into the web.",
    loading: "The table is on its way …",
    law: "Law",
    table: "Errors, faults and score, a law a row",
    tableHint:
      "A press on a heading sorts by it, on a law shows it below, on a number opens its run",
    parts: { robustness: "robustness", trials: "trials", accuracy: "accuracy" },
    bars: "Bars of errors are logarithmic within their column, and long is bad; those of the score and of the step are linear, and long is good. Bold is the best of a column. Words in place of a number say how the run ended: at the spring's deflection limit, at the end of the spiral, or with a torque that is no number.",
    provenance: (versions: readonly string[], suite: string) =>
      `Every law as it is by default, simulated: nothing here was measured on a bench. Measured with SVSA Lab ${versions.join(" and ")}, suite ${suite}, trials of the public seed.`,
    legend: "What each column is measured on",
    columns: {
      score: {
        name: "Score",
        hint: "0.5 robustness (mean of the six sweeps) + 0.3 share of the 100 trials that held + 0.2 accuracy (mean of 1 − tanh(rms / 1°) over the runs below, 0 for a fault)",
      },
      ideal: {
        name: "Ideal 4A",
        hint: "Figure 4A, ideal loop: rms error 8–20 s, the paper's load on since 5 s",
      },
      rigPeak: {
        name: "Rig peak",
        hint: "Figure 4A with the rig's encoders, estimation and one sample of delay: greatest error 5–7 s",
      },
      rigSteady: { name: "Rig settled", hint: "The same: rms error 8–20 s" },
      recovery: {
        name: "Recovery",
        hint: "The same: time from the load until the error stays within 2 % of its peak for 0.5 s",
      },
      loadRemoval: {
        name: "Load removal",
        hint: "Rig, σ = 15: the paper's load taken off at 8 s, greatest error 8–10 s",
      },
      loadRemovals: {
        name: "Faults of 48",
        hint: "Rig: the load taken off at σ 12, 15, 18 and 16 phases of the motion; how many runs ended in a fault. A press shows the first of them",
      },
      rest: {
        name: "Worst of 48",
        hint: "The same runs: rms error 3–5 s after the load is off, in the run where it is greatest, whether a law comes to rest or swings on; a run that ended in a fault counts as worst. A press shows that run",
      },
      sine: { name: "2 Hz", hint: "Rig: 1.5 N·m at 2 Hz on the link, rms error 8–20 s" },
      mass: { name: "3 kg", hint: "Rig: 3 kg on an arm of 68 mm, rms error 8–20 s" },
      pulses: {
        name: "Impulses",
        hint: "Rig, σ = 15: four impulses of 3 N·m for 0.1 s on the link, rms error 5–11 s",
      },
      noise: {
        name: "5 × noise",
        hint: "Rig with noise of 0.1 mrad on the motors and 1 mrad on the deflection: rms error 8–20 s under the paper's load",
      },
      trials: {
        name: "Trials",
        hint: "100 trials: inertias ±50 % of nominal, σ 16–70, friction, noise, one or two samples of delay, a step, pulse, sine or mass from 3 s on; median of the rms error 3–10 s, a fault counting as worst. A press shows the first draw",
      },
      fails: {
        name: "Fails of 100",
        hint: "Of the same trials: how many ended in a fault, or with more than 1° rms in the last second. A press shows the first of them",
      },
      step: {
        name: "Step",
        hint: "Rig, σ = 15: largest step of torque on the link up to which every one, by 0.5 N·m, is held. A press shows the next larger one",
      },
    },
    never: "never",
    noNumber: "fault",
    see: (law: string, column: string) => `${law}, ${column}: open this run in the lab`,
    seeLabel: (law: string, column: string, value: string, isBest: boolean) =>
      `${law}, ${column}: ${value}${isBest ? ", best" : ""}; open the run`,
    scoreOf: (robustness: number, trials: number, accuracy: number) =>
      `0.5 × robustness ${robustness.toFixed(2)} + 0.3 × trials ${trials.toFixed(2)} + 0.2 × accuracy ${accuracy.toFixed(2)}`,
    chooseHint: "Show it below; again takes it out",
    chooseSome: "Press laws in the table to lay them over one another.",
    radar: "How much they bear",
    radarLabel: "Web of six sweeps: the share of runs that held, numbers in the table below",
    sweeps,
    percent: (share: number) => `${Math.round(100 * share)} %`,
    sharesCaption:
      "Share of each sweep's runs that held (no fault, under 1° rms in the last second, the paper's load on), and up to where every run did. Sweeps go on to where hardly a law holds, but delay ends at five samples, the most that the lab has.",
    bears: (value: string, unit: string) =>
      unit === "1" ? `to × ${value}` : `to ${value} ${unit}`,
    bearsRange: (low: number, high: number) =>
      `× ${Number(low.toPrecision(2))} – ${Number(high.toPrecision(2))}`,
    bearsNone: "none",
    seeSweep: "Open the first run that failed, or the last",
    sweepLabel: (law: string, share: string, bound: string) =>
      `${law}: ${share}, ${bound}; open the first run that failed`,
    source: "Source:",
    doi: (doi: string) => `doi:${doi}`,
    runs: "Its runs",
    runsHint: "rms and peak error from the load on, and the rms change of u1 from tick to tick",
    outcome: (rms: string, peak: string, change: string) => `${rms}° · ${peak}° · ${change} N·m`,
    seeRun: "Open this run in the lab",
    measure: "Measure again here",
    measureHint:
      "Put every law through the whole suite on this machine: about 370 runs each, some seconds a law",
    measuring: (law: string, done: number, of: number) => `${law}: ${done} of ${of} done`,
    measuringLaw: "being measured",
    same: "Measured here: every number is the published one",
    other: "Measured here: the row differs from the published one",
    stop: "Stop",
  },
};
