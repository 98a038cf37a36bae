/** Tools of the lab page: 3D view, keyboard, calls as code. */
/** The tools of the 3D view. */
export const sceneText = {
  scene: {
    tools: "3D view",
    camera: "Camera",
    cameras: { whole: "Whole", front: "Front", side: "Side", spring: "Spring" },
    cameraHint: (name: string) => `Camera: ${name}`,
    push: "Push",
    pushHint: "Take the link with the mouse and pull: a spring pushes it towards the pointer",
    pushLayer:
      "Drag to push the link; the arrows left and right push by 1 N·m while they are down, Esc ends",
    pulling: (torque: string) => `${torque} N·m`,
    names: "Names of the parts",
    namesHint: "motors, spiral, pivot, lever and spring, in this window only",
    low: "Low graphics",
    lowHint: "Fewer parts, coarser, 15 pictures a second: for computers without a graphics card",
  },
} as const;

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

/** From clicks to scripts. */
export const scriptText = {
  script: {
    open: "Calls as code",
    openHint: "What you did here, as Python and curl (P)",
    title: "Calls",
    count: (total: number) => (total === 1 ? "1 call" : `${total} calls`),
    empty: "Press anything: the call behind it appears here.",
    list: "Calls of this page, newest last",
    language: "Language",
    languages: { python: "Python", curl: "curl" },
    at: (time: string) => `at ${time}`,
    refused: (status: number) => `refused, ${status}`,
    unreached: "no answer",
    copyOne: (what: string) => `Copy ${what}`,
    copy: "Copy",
    copyAll: "Copy all",
    clear: "Clear",
    close: "Close",
    copied: "Copied",
    notCopied: "This browser does not let the page copy: save it instead.",
    experiment: "Copy this experiment as a script",
    experimentHint:
      "A Python file that does again, in a private session, what was done since the run began",
    save: "Save .py",
    saveHint: "The same as a file",
    fileName: "experiment.py",
    experimentTitle: (laws: string) => `${laws} in the lab`,
  },
} as const;
