/** Studies: many perturbed runs of every law. */
const samples = (count: number) => (count === 1 ? "1 sample" : `${count} samples`);

export const studiesText = {
  studies: {
    title: "Studies",
    lead: "Repeats one experiment with varied settings, for several laws on the same samples. Each dot is a run: select one to see it in 3D.",
    loading: "Loading the studies …",
    loadingRuns: "Loading the runs …",
    kept: "My studies",
    state: (done: number, rows: number) =>
      `${done.toLocaleString("en")} of ${rows.toLocaleString("en")} runs`,
    begin: "New study",
    source: "Study",
    own: "Custom (TOML) …",
    text: "Definition (TOML)",
    name: "Save as",
    nameHint: "1 to 64 letters, digits, -, _ or .; default: the study's name",
    runs: "Samples",
    runsHint:
      "Number of samples, each run under every law; default: as defined in the study. For a grid: repetitions of the complete grid",
    laws: "Laws",
    lawsHint: "Default: the laws of the study",
    metrics: "Metrics",
    metricsHint: "Metrics stored for each run; default: those of the study",
    asInStudy: "study default",
    success: "Success criterion: no fault, and",
    successHint:
      "Bounds that a run must meet in addition to completing without a fault; default: as defined in the study",
    most: "at most",
    check: "Check",
    checked: (samples: number, rows: number, laws: string) =>
      `Valid: ${samples.toLocaleString("en")} samples, ${rows.toLocaleString("en")} runs under ${laws}.`,
    start: "Start",
    goOn: "Continue",
    goOnHint: "Run the remaining samples",
    delete: "Delete",
    deleting: "Deleting …",
    deleteHint: "Delete this study and all its rows from the disk",
    deleteSure: (name: string, done: number) =>
      `Delete study ${name} with its ${done.toLocaleString("en")} runs? A running study is cancelled first. This cannot be undone; runs that you opened in 3D stay in the list.`,
    deleteNow: "Delete permanently",
    progress: (name: string) => `Progress of study ${name}`,
    table: "Table (Parquet)",
    tableHint: "All rows and columns, written when the study ended or was cancelled",
    empty: "No run completed yet: dots appear as blocks of runs complete.",
    thinned: (shown: number, total: number) =>
      `${shown.toLocaleString("en")} of ${total.toLocaleString("en")} runs are shown, chosen at random; the table by law above uses all runs.`,
    plane: { s: "First plane", t: "Second plane" },
    x: "Across",
    y: "Up",
    dotsHint:
      "Drag to brush, select a dot to pick a run. Keyboard: arrow keys move between runs, Escape clears the brush",
    dotsLabel: (x: string, y: string, count: number) =>
      `${y} over ${x}: ${count} runs in the brush. Arrow keys move between runs`,
    missing: (count: number) =>
      `${count.toLocaleString("en")} runs have no such value: they ended before it could be measured`,
    marks: "● succeeded  ○ not succeeded  × fault",
    map: "Success rate",
    of: (isBrushed: boolean) => (isBrushed ? "Of the brushed runs" : "Of every run shown"),
    mapHint: "over the first plane; select a cell to brush it",
    shown: "Planes and map show",
    everyLaw: "all laws, overlaid",
    mapScale: (share: number) => `${share} %`,
    distribution: "Cumulative distribution",
    distributionHint: "a run with a fault counts as larger than any value",
    metric: "Metric",
    below: "Runs below, %",
    brushed: (count: number, total: number) =>
      count === total
        ? `All ${total.toLocaleString("en")} runs`
        : `${count.toLocaleString("en")} of ${total.toLocaleString("en")} runs in the brush`,
    clear: "Clear the brush",
    from: (axis: string) => `${axis} from`,
    to: (axis: string) => `${axis} to`,
    byLaw: "By law, all runs",
    summing: "Computing …",
    later: "Computed when the study has ended.",
    law: "Law",
    all: "Runs",
    succeeded: "Succeeded",
    inBrush: "In the brush",
    faults: "Faults",
    noFaults: "none",
    refused: (count: number) => `${samples(count)} not run: incompatible settings`,
    median: (metric: string) => `${metric}: 5, 50 and 95 % quantile`,
    fault: "fault",
    interval: (share: string, low: string, high: string) => `${share} % (${low} to ${high})`,
    estimate: (value: string, low: string | null, high: string | null) =>
      low === null ? `${value} (no interval)` : `${value} (${low} to ${high})`,
    pair: (first: string, second: string) => `${first} − ${second}`,
    points: (estimate: string) => `${estimate} percentage points`,
    pSuccess: (value: string) => `McNemar's p-value, Holm-corrected: ${value}`,
    pMetric: (value: string) => `Wilcoxon's p-value, Holm-corrected: ${value}`,
    pSmall: "< 0.0001",
    only: (first: number, second: number) =>
      `only the first succeeded: ${samples(first)}; only the second: ${second}`,
    difference: (metric: string, whole: number) =>
      `${metric}, over ${samples(whole)} on which both finished`,
    sensitivity: "Sensitivity of the success",
    sensitivityHint:
      "Sobol indices of the success: share of its variance due to each setting alone (first order) and including interactions (total). The intervals treat the points of the Sobol' sequence as independent and are therefore upper bounds",
    itself: "first order",
    together: "total",
    row: (row: number) => `Run ${row}`,
    see: "Open in 3D",
    seeHint: "Simulates the run again and records every sample",
    overlay: "Overlay both runs",
    seeing: "Simulating the run …",
    outcome: {
      good: "succeeded",
      missed: "no fault, success criterion not met",
      fault: (code: string) => `fault: ${code}`,
    },
    pickHint: "Select a dot to see its settings and result, next to the previously selected run.",
  },
};
