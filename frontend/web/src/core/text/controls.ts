/** The settings. */
export const controlsText = {
  controls: {
    heading: "Controls",
    index: "Controls below",
    slider: (label: string) => `${label}, slider`,
  },
  refusal: {
    outOfRange: (name: string, value: string, bound: string) =>
      `${name}: ${value} is out of range, ${bound}. It stays as it was.`,
    missing: (name: string) => `${name} is missing.`,
    finding: (name: string, finding: string) => `${name}: ${finding}.`,
    wrong: (name: string, bound: string) => `${name} must be ${bound}.`,
    noNumber: "This is no number. It stays as it was.",
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
      series: "A spline of degree 7 through every row, from rest to rest.",
    },
    openCsv: "Open CSV…",
    pasteCsv: "Time series as CSV",
    csvHint: "The head names the unit. 2 to 2000 rows; a bench that moves takes 200.",
    levels: (unit: string) => `Steps: time in s, level in ${unit}`,
    levelsHint: (unit: string, most: number) =>
      `A line each: time s, level ${unit}. Up to ${most}; a bench that moves takes ${most / 2}.`,
    noLevel: (line: number, written: string) =>
      `Line ${line} is “${written}”: it must be a time and a level.`,
    levelCount: (count: number, most: number) =>
      `The list has ${count} lines: it must have 1 to ${most}.`,
    example: {
      position: "time_s,position_deg\n0,0\n1,30\n2,-30\n3,0\n",
      stiffness: "time_s,stiffness_nm_per_rad\n0,15\n1,30\n3,15\n",
    },
    isOther: {
      position: "This CSV holds positions: open it under Motion.",
      stiffness: "This CSV holds stiffness: open it under Stiffness.",
    },
    course: (least: string, greatest: string, unit: string, end: string, rate: string) =>
      `${least} to ${greatest} ${unit} in ${end} s, at most ${rate} ${unit}/s`,
    apply: "Apply",
    again: "Begin again",
    againHint: "What is followed now, from its beginning",
    notApplied: (kind: string) => `Following now: ${kind}. What stands here is not applied yet.`,
    following: (kind: string, fadeS: number) =>
      `Following now: ${kind}. It fades in for ${fadeS} s, then begins; its end is held.`,
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
    each: "Each channel by itself",
    spread: "The channels differ; the slider sets all three.",
    unused: (law: string) => `${law} does not use this estimate; the observer runs beside it.`,
  },
  load: {
    title: "Load",
    weight: "3 kg",
    hang: "Hang 3 kg",
    remove: "Remove 3 kg",
    hangs: "3 kg on the link now",
    acts: "2 N·m on link and motors now",
    markHung: "I hung 3 kg",
    markRemoved: "I took 3 kg off",
    mark: "marks it in the data",
    marked: "marked as hanging",
    markDoes: "Hang 3 kg on the link by hand, then press the button: it marks the moment.",
    comesAt: (time: number) => `comes by itself at ${Number(time.toFixed(2))} s`,
    paperShort: "2 N·m on link and motors",
    massShort: "a mass on a 68 mm arm",
    form: "What 3 kg are",
    paper: "Paper’s torques",
    torque2: "2 N·m",
    mass: "Hung mass",
    paperDoes: "The button adds 2 N·m to the link and to both motors, as the paper prints it.",
    massDoes: "The button hangs 3 kg on a 68 mm arm: gravity turns with the link, inertia grows.",
    removeThis: (what: string) => `Remove ${what}`,
    removeAll: "Remove all loads",
    custom: "A torque of your own",
    customKind: "Shape of the torque",
    customChannel: "Where it acts",
    torque: "Torque",
    duration: "Duration",
    frequency: "Frequency",
    apply: "Apply torque",
  },
} as const;

/** The laws to choose from, and the controllers that run beside the session's own. */
export const lawsText = {
  laws: {
    choose: "Choose the law that controls",
    search: "Search laws",
    presentSign: "✓",
    found: (count: number) => (count === 1 ? "1 law" : `${count} laws`),
    none: "No law has these words.",
    notInstalled: (name: string) => `${name} (not installed)`,
    broken: (name: string) => `${name} (does not load)`,
    groups: {
      none: "Without ŵ: by feedback, an integral or an extended state",
      observer: "With the observer's estimate ŵ",
      own: "With an estimate of their own",
    },
  },
  beside: {
    list: "Beside it",
    add: "Add",
    addHint: "Run one more law beside, or the same one with other settings",
    full: (most: number) => `${most} run already: remove one first.`,
    law: (name: string) => `Law of ${name}`,
    lawHint: "Another law for this actuator, from where it is",
    set: (name: string) => `Settings of ${name}`,
    setHint: "What it is set to",
    remove: (name: string) => `Remove ${name}`,
    own: "own settings",
    ownHint: "It has settings of its own. ",
    sharedHint: "Set as the session's. What is changed here becomes its own.",
    share: "As the session's",
    poles: (group: string) => `${group} bandwidth, all poles`,
    apart: (symbol: string) => `The poles lie apart; ${symbol} sets all of them.`,
  },
  lawText: {
    file: "A Python file",
    text: "Its text, or paste it here",
    most: (bytes: number) => `At most ${bytes} bytes.`,
    tooLong: (bytes: number, most: number) => `It has ${bytes} bytes; at most ${most} are taken.`,
    unreadable: "This file cannot be read as text.",
  },
} as const;

/** From an excitation to a model of one's own. */
export const identificationText = {
  identification: {
    title: "Identification",
    runName: "Identification",
    explanation:
      "Plays 32 s of motion, slow and fast, soft and stiff, and records it. Estimate the" +
      " parameters from that run with",
    command: "svsa identify RUN --output mine-design.toml",
    excite: "Excite and record",
    exciting: (elapsed: string, all: string) => `Exciting: ${elapsed} of ${all}`,
    stop: "Break off",
    file: "Parameter file as the model …",
    fileHint:
      "Takes the nominal model, in which controller and observer believe from then on, and the" +
      " parameters of laws. Gains, observer, the true plant and limits stay as they are.",
    bench: "A bench takes the file at its start: [design] file in the bench file.",
  },
} as const;
