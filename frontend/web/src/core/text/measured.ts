/** Texts of metrics and their window, the same on every page. */
export const measuredText = {
  names: { rms: "rms", peak: "Peak", settled: "Steady-state error", recovered: "Recovery time" },
  whole: "Whole run",
  start: "From the start",
  /** From, in seconds, of an open window. */
  since: "{{what}}, since {{from}} s",
  /** From and to, in seconds. */
  during: "{{what}}, {{from}}–{{to}} s",
  controlled: "{{lanes}}: {{what}}",
  steadyStateHint: "rms position error over the last 0.5 s of the window",
  loadEnded: "No steady-state error under load: the load ended before.",
  tooShort: "The window is shorter than 1 s.",
} as const;
