/** Tools of the lab page: 3D view, keyboard, calls as code. */
/** The tools of the 3D view. */
export const sceneText = {
  scene: {
    tools: "3D view",
    camera: "Camera",
    cameras: { whole: "Whole", front: "Front", side: "Side", spring: "Spring", top: "Above" },
    cameraHint: "Camera: {{name}}",
    push: "Push",
    pushHint: "Drag the link with the mouse: a virtual spring pulls it towards the pointer",
    pushLayer:
      "Drag to push the link; the arrows left and right push by 1 N·m while they are down, Esc ends",
    pulling: "{{torque}} N·m",
    names: "Names of the parts",
    namesHint: "motors, spiral, pivot, lever and spring, in this window only",
    schematic: "The actuator from the front: link, reference and load",
    noWebGl:
      "This browser has no WebGL, which the 3D view needs. The same angles in 2D: the link in the color of its curve, the reference dotted, disturbance torques as arrows.",
    low: "Low graphics",
    lowHint: "Fewer and coarser parts, 15 frames per second: for computers without a graphics card",
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
      record: "Start or stop recording",
      load: "Hang or remove 3 kg",
      compare: "Switch the comparison on or off",
      hold: "Hold the dead-man's switch of the bench, as long as it is down",
      zoom: "Zoom of the last event next to the plots",
      names: "Names of the parts in the 3D view",
      runs: "Recorded runs, and back to the lab",
      calls: "Your calls as Python and curl",
      help: "Show or hide this sheet",
      close: "Close what is open",
    },
    benchRun: "Ramp down and stop; on a bench no key starts a motor",
    switch: "Enable single-key shortcuts",
    switchHint: "Shift + Esc always works. Keys typed into a field are no shortcuts.",
  },
} as const;

/** From clicks to scripts. */
export const scriptText = {
  script: {
    open: "Calls as code",
    openHint: "Your calls as Python and curl (P)",
    title: "Calls",
    count_one: "{{count}} call",
    count_other: "{{count}} calls",
    empty: "Use any control: its API call appears here.",
    list: "Calls of this page, newest last",
    language: "Language",
    languages: { python: "Python", curl: "curl" },
    at: "at {{time}}",
    refused: "rejected, {{status}}",
    unreached: "no answer",
    copyOne: "Copy {{what}}",
    copy: "Copy",
    copyAll: "Copy all",
    clear: "Clear",
    close: "Close",
    copied: "Copied",
    notCopied: "This browser does not allow copying: save the file instead.",
    experiment: "Copy this experiment as a script",
    experimentHint:
      "A Python file that repeats, in a private session, all commands since the run started",
    save: "Save .py",
    saveHint: "Save the script as a file",
    fileName: "experiment.py",
    experimentTitle: "{{laws}} in the lab",
  },
} as const;
