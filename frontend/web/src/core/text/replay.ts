/** Texts of the page of an exported run; its plots use those of the live page. */
import { measuredText } from "./measured";
import { plotsText } from "./plots";

export const text = {
  channelLabels: plotsText.channelLabels,
  name: "SVSA Lab",
  recorded: "recorded run",
  broken: "This file is damaged or incomplete: the run in it cannot be read.",
  view: "The actuator in 3D",
  noView: "The 3D view cannot start in this browser: it needs WebGL. The plots work without it.",
  drawn: {
    lane: "actuator",
    ghost: "link in outline",
    reference: "reference angle",
    ellipse: "tip stiffness",
  },
  transport: {
    heading: "Playback",
    play: "Play",
    pause: "Pause",
    keys: "Space plays and pauses. Arrows move by a frame, with Shift by a second. Home and End move to the ends",
    time: "Time",
    of: (duration: string) => `of ${duration}`,
    speed: "Speed",
    times: (factor: number) => `${factor}×`,
    whole: "Whole run",
    wholeHint: "Show the whole run in the plots (double click on a plot)",
    zoomIn: "Zoom in",
    zoomOut: "Zoom out",
    seconds: (seconds: number) => `${seconds.toFixed(2)} s`,
  },
  numbers: {
    heading: (window: string) => `Errors · ${window}`,
    hint: "Computed from every sample of this window, in which no setting changed",
    lane: "Lane",
    rms: measuredText.names.rms,
    peak: measuredText.names.peak,
    settled: measuredText.names.settled,
    position: "Position",
    stiffness: "Stiffness",
    degrees: "deg",
    stiffnessUnit: "N·m/rad",
  },
  events: {
    heading: "Events",
    none: "No events",
    jump: (time: string, label: string) => `Go to ${time} ${label}`,
  },
  about: {
    open: "About this run",
    close: "Close",
    version: "version",
    drawn: (stride: number) =>
      stride === 1
        ? "The curves show every sample of the run."
        : `The curves show one of every ${stride} samples, and the peaks between them.`,
    empty: "none",
    more: (count: number) => `and ${count} more`,
  },
  plots: {
    ...plotsText.plots,
    hint: "Click: go to this time. Drag: zoom in. Double click: whole run.",
    choose: (title: string) => `${title}: which one`,
  },
} as const;
