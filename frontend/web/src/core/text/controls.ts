/** Texts of the settings. */
export const controlsText = {
  controls: {
    heading: "Controls",
    index: "Controls below",
    slider: (label: string) => `${label}, slider`,
  },
  refusal: {
    outOfRange: (name: string, value: string, bound: string) =>
      `${name}: ${value} is out of range (${bound}). The value is unchanged.`,
    missing: (name: string) => `${name} is missing.`,
    finding: (name: string, finding: string) => `${name}: ${finding}.`,
    wrong: (name: string, bound: string) => `${name} must be ${bound}.`,
    between: (least: string, most: string) => `from ${least} to ${most}`,
    atLeast: (bound: string) => `at least ${bound}`,
    moreThan: (bound: string) => `more than ${bound}`,
    atMost: (bound: string) => `at most ${bound}`,
    lessThan: (bound: string) => `less than ${bound}`,
  },
  motion: {
    title: "Motion",
    kind: "Kind of motion",
    sine: "Sine",
    constant: "Hold",
    amplitude: "Amplitude",
    frequency: "Frequency",
    offset: "Offset",
    position: "Position",
  },
  stiffness: {
    title: "Stiffness",
    kind: "Kind of stiffness",
    constant: "Constant",
    sine: "Sine",
    level: "Stiffness",
    fixed: (actuator: string, sigma: string) =>
      `${actuator}: ${sigma} N·m/rad. The actuator has no stiffness motor.`,
    throughout: "Stiffness at all times",
    mean: "Mean",
    amplitude: "Amplitude",
    frequency: "Frequency",
  },
  references: {
    other: "Other",
    kind: "Shape",
    kinds: {
      steps: "Steps",
      series: "CSV",
    },
    inputs: {
      low: "First level",
      high: "Second level",
      hold: "Every",
      count: "Steps",
    },
    does: {
      steps: "Each step rises smoothly in 0.2 s.",
      series: "A spline of degree 7 connects all rows and starts and ends at rest.",
    },
    openCsv: "Open CSV…",
    pasteCsv: "Time series as CSV",
    csvHint: "The header names the unit. 2 to 2000 rows; at most 200 while a bench moves.",
    levels: (unit: string) => `Steps: time in s, level in ${unit}`,
    levelsHint: (unit: string, most: number) =>
      `One line per step: time in s, level in ${unit}. At most ${most}; ${most / 2} while a bench moves.`,
    noLevel: (line: number, written: string) =>
      `Line ${line} is “${written}”; expected a time and a level, separated by a space.`,
    levelCount: (count: number, most: number) =>
      `The list has ${count} lines; expected 1 to ${most}.`,
    example: (column: string, low: number, high: number) =>
      `time_s,${column}\n0,${low}\n1,${high}\n3,${low}\n`,
    isOther: {
      position: "This CSV holds positions: open it under Motion.",
      stiffness: "This CSV holds stiffness: open it under Stiffness.",
    },
    course: (least: string, greatest: string, unit: string, end: string, rate: string) =>
      `${least} to ${greatest} ${unit} in ${end} s, at most ${rate} ${unit}/s`,
    apply: "Apply",
    again: "Restart",
    againHint: "Restart the current reference from its beginning",
    notApplied: (kind: string) => `Active: ${kind}. The settings shown here are not applied yet.`,
    following: (kind: string, fadeS: number) =>
      `Active: ${kind}. It fades in over ${fadeS} s, then starts; its last value is held.`,
  },
  controller: {
    title: "Controller",
    exact: "Model: exact. The nominal parameters are those of the plant.",
    law: "Control law",
    fl: "FL",
    ndobc: "NDOBC",
  },
  gains: {
    coefficients: "Gains, coefficient by coefficient",
    coefficient: (symbol: string, index: number) => `c${"₀₁₂₃"[index]} of ${symbol}`,
    coefficientUnit: (power: number) => (power === 1 ? "1/s" : `1/s${"⁰¹²³⁴"[power]}`),
  },
  observer: {
    title: "Observer",
    all: "Bandwidth β",
    each: "Each channel separately",
    spread: "The channels differ; the slider sets all three.",
    unused: (law: string) => `${law} does not use this estimate; the observer runs in parallel.`,
  },
  load: {
    title: "Load",
    weight: "3 kg",
    massSign: "m",
    hang: "Hang 3 kg",
    remove: "Remove 3 kg",
    hangs: "3 kg hang on the link",
    acts: "2 N·m act on link and motors",
    markHung: "I hung 3 kg",
    markRemoved: "I removed 3 kg",
    mark: "marks it in the data",
    marked: "marked as hanging",
    markDoes: "Hang 3 kg on the link by hand, then press the button to mark the time.",
    comesAt: (time: number) => `added automatically at ${Number(time.toFixed(2))} s`,
    paperShort: "2 N·m on link and motors",
    massShort: "a mass on a 68 mm arm",
    form: "Model of the 3 kg load",
    paper: "Paper’s torques",
    torque2: "2 N·m",
    mass: "Hanging mass",
    paperDoes: "The button adds 2 N·m to the link and to both motors, as published.",
    massDoes: "The button hangs 3 kg on a 68 mm arm: gravity turns with the link, inertia grows.",
    addTorque: "Add load",
    removeTorque: "Remove load",
    torqueSign: "τ",
    torqueShort: (torque: string) => `${torque} N·m on the link`,
    torqueDoes:
      "The button adds a torque on the link that the actuator holds at its default stiffness.",
    removeThis: (what: string) => `Remove ${what}`,
    removeAll: "Remove all loads",
    custom: "Custom torque",
    customKind: "Shape of the torque",
    customChannel: "Acts on",
    torque: "Torque",
    duration: "Duration",
    frequency: "Frequency",
    apply: "Apply torque",
  },
} as const;

/** The control laws, and the comparison lanes. */
export const lawsText = {
  laws: {
    choose: "Choose the law that controls",
    search: "Search laws",
    presentSign: "✓",
    found: (count: number) => (count === 1 ? "1 law" : `${count} laws`),
    none: "No law matches.",
    notInstalled: (name: string) => `${name} (not installed)`,
    broken: (name: string) => `${name} (does not load)`,
    groups: {
      none: "Without ŵ: by feedback, an integral or an extended state",
      observer: "With the observer's estimate ŵ",
      own: "With their own estimate",
    },
  },
  comparisons: {
    list: "Compared with",
    add: "Add",
    addHint: "Add a comparison lane: another law, or the same law with other settings",
    full: (most: number) => `At most ${most} lanes: remove one first.`,
    law: (name: string) => `Law of ${name}`,
    lawHint: "Change the law of this lane; its plant keeps its state",
    set: (name: string) => `Settings of ${name}`,
    setHint: "Settings of this lane",
    remove: (name: string) => `Remove ${name}`,
    own: "own settings",
    ownHint: "This lane has its own settings. ",
    sharedHint: "Uses the session's settings. A change here applies to this lane only.",
    share: "Use the session's settings",
    poles: (group: string) => `${group} bandwidth, all poles`,
    apart: (symbol: string) => `The poles differ; ${symbol} sets all of them.`,
  },
  lawText: {
    file: "A Python file",
    text: "Its text, or paste it here",
    most: (bytes: number) => `At most ${bytes} bytes.`,
    tooLong: (bytes: number, most: number) => `The text has ${bytes} bytes; the limit is ${most}.`,
    unreadable: "This file cannot be read as text.",
  },
} as const;

/** From an excitation to an identified model. */
export const identificationText = {
  identification: {
    title: "Identification",
    open: "Identify …",
    openHint: "Record a run that excites the actuator, and load the parameters estimated from it",
    runName: "Identification",
    explanation:
      "Runs and records 32 s of slow and fast motion at low and high stiffness. Estimate the" +
      " parameters from that run with",
    command: "svsa identify RUN --output mine-design.toml",
    excite: "Excite and record",
    exciting: (elapsed: string, all: string) => `Exciting: ${elapsed} of ${all}`,
    stop: "Cancel",
    file: "Parameter file as the model …",
    fileHint:
      "Loads the nominal model that controller and observer use, and the" +
      " parameters of laws. Gains, observer, true plant and limits are unchanged.",
    bench: "For a bench, set [design] file in the bench file and restart.",
  },
} as const;
