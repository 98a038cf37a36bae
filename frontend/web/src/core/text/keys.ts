/** The keyboard and its help sheet. */
export const keysText = {
  keys: {
    open: "Keyboard shortcuts",
    title: "Keyboard",
    names: { space: "Space", escape: "Esc", shift: "Shift" },
    does: {
      stop: "Quick stop: from anywhere, in a text field too",
      run: "Run or pause",
      record: "Begin or end a recording",
      load: "Hang or remove 3 kg",
      compare: "Switch the comparison on or off",
      hold: "Hold the dead-man's switch of the bench, as long as it is down",
      zoom: "Zoom of the last event beside the plots",
      names: "Names of the parts in the 3D view",
      runs: "Recorded runs, and back to the lab",
      calls: "What you did, as Python and curl",
      help: "Show or hide this sheet",
      close: "Close what is open",
    },
    benchRun: "Stop on a ramp; on a bench no key starts a motor",
    switch: "Single keys command the page",
    switchHint: "Shift + Esc does in any case. Keys typed into a field never do.",
  },
} as const;
