/** Learning pages: the tour, the equations, the paper's claims. */
export const learningText = {
  learning: {
    title: "Learn",
    lead: "Exercises: predict, run, explain. Your prediction is saved before the run and compared with the measured result.",
    equations: "Equations",
    equationsHint: "Each equation also opens from its symbol on the page.",
  },
  lesson: {
    exercises: "Exercises",
    all: "All exercises",
    loading: "Loading…",
    exercise: (number: number) => `Exercise ${number}`,
    label: (title: string) => `Exercise: ${title}`,
    minutes: (minutes: number) => `${minutes} min`,
    points: (points: number) => (points === 1 ? "1 point" : `${points} points`),
    begin: "Start",
    goOn: "Continue",
    look: "Review",
    done: (done: number, all: number) => `${done} of ${all} steps`,
    progress: "Steps done",
    submitted: (points: number, most: number) => `Submitted: ${points} of ${most} points`,
    pointsAndLaw: (points: number, law: number) =>
      law > 0 ? `${points} points, ${law} more for the law` : `${points} points`,
    steps: "Steps",
    stepDone: "done",
    previous: "Back",
    next: "Next",
    kinds: {
      read: "Read",
      predict: "Predict",
      experiment: "Experiment",
      explain: "Explain",
      submit: "Submit",
    },
    goal: "Goal",
    from: (low: string, high: string, unit: string) =>
      `from ${low} to ${high}${unit && ` ${unit}`}`,
    keep: "Save prediction",
    change: "Change prediction",
    kept: (answer: string, unit: string) => `You predicted ${answer}${unit && ` ${unit}`}.`,
    keptHint: "You can change it until the run is set up.",
    isKept: "The run is set up: the prediction is final.",
    choose: "Choose",
    chosenOnce: "You can answer once; then the solution is shown.",
    setUp: "Set up",
    setUpAndRun: "Set up and run",
    again: "Run again",
    run: "Run and record",
    setUpHint: "Applies the settings of this step and resets to time 0",
    runHint: "Runs from time 0 with the current settings and records to the end",
    free: (what: string) => `Free settings: ${what}.`,
    freeNames: {
      law: "law",
      comparisons: "comparison lanes",
      gains: "gains",
      parameters: "parameters of the law",
      observer: "observer",
      stiffness: "stiffness",
      position: "motion",
      effects: "realism",
    } as Readonly<Record<string, string>>,
    asked: "Criteria of the run",
    seconds: (now: number, end: number) =>
      `Running: ${Math.min(now, end).toFixed(1)} of ${end} s, then it is assessed.`,
    judging: "Assessing the run…",
    predictFirst: (step: string) => `Predict first: ${step}`,
    results: "Result",
    right: "Right",
    partly: "Partly",
    wrong: "Not yet",
    show: (time: string) => `Show ${time} s`,
    showHint: "Pauses the plots around this time; older runs open in the replay",
    missing: "Still missing:",
    name: "Your name",
    law: {
      label: "Your law",
      start: "Insert the law above",
      try: "Test and save",
      tryHint: "Runs the law in an isolated process on a public scenario",
      trying: "Testing the law; takes a few seconds…",
      verdicts: {
        held: "Passed",
        ran: "Completed, criteria not met",
        ended: "The run ended early",
        failed: "Error in the law",
        untried: "Saved, not tested",
      },
      output: "Output of the law",
      changed: "The text above differs from the saved law: test it, or the saved law is submitted.",
      tryFirst: "Test your law to save it.",
      later: (points: number) =>
        `The law earns up to ${points} more points when it is graded on trials sampled from your submission.`,
    },
    submit: "Submit",
    submitHint: "Only once: afterwards the exercise cannot be changed.",
    held: (name: string) => `${name} is in control of this session.`,
    unheld: "No user is in control of this session.",
    ask: "Request control",
    simulatedOnly:
      "This step sets plant and effects, which a bench does not allow: run it in a private simulated session.",
    armOnly: "This step is an experiment of an arm: run it in a private session of the arm.",
    openArm: "Open session of arm",
    jointOnly: "This step is an experiment of a single joint, and this session is of an arm.",
    openJoint: "Open session of single joint",
    before: "Before the run:",
    above: "The bench's buttons are at the top of the page.",
    loadOfEmulator: "The emulator adds the load automatically.",
    manualLoads: (what: string, loads: readonly { time_s: number; is_on: boolean }[]) =>
      `By hand at the bench: ${what}; ${loads
        .map(({ time_s: at, is_on: isOn }) => `${isOn ? "on" : "off"} at ${at} s`)
        .join(", ")}. Keep clear of the link before and after.`,
    manualLoadAt: (what: string, isOn: boolean, at: number) =>
      isOn ? `At ${at} s by hand: ${what}.` : `At ${at} s by hand: remove the load.`,
    manualLoadNow: (what: string, isOn: boolean) =>
      isOn ? `Now by hand: ${what}.` : "Now by hand: remove the load.",
    cut: {
      control: (time: string) => `You lost control at ${time} s, in the middle of the run.`,
      stopped: (time: string) => `The bench was stopped at ${time} s, before the run's end.`,
    },
    cutAgain: "The run is not assessed: restart the step.",
    hasSettings: "This session has the settings of an exercise.",
    restore: "Restore earlier settings",
    resume: "Return to the exercise",
  },
  tour: {
    label: "Tour of the lab",
    take: "Take the tour",
    skip: "Skip",
    next: "Next",
    back: "Back",
    done: "Done",
    of: (step: number, all: number) => `${step} of ${all}`,
    keys: "Arrow keys: next and previous. Esc: skip.",
    viewIn2d: {
      title: "The actuator",
      words:
        "The thick line is the link from the front; the dotted line is its reference. The circle is the axis of the motors.",
    },
    steps: {
      welcome: {
        title: "Welcome to the lab",
        words:
          "One motor moves a link through a spring; a second motor changes how stiff that spring is. See it in six short steps.",
      },
      view: {
        title: "The actuator",
        words:
          "The link is white, its reference pale. The principal motor is blue, the stiffness motor brass. The spring turns from blue to red with increasing stiffness.",
      },
      plots: {
        title: "The plots",
        words:
          "The reference is dotted, the chosen controller solid. With good tracking you see one line.",
      },
      load: {
        title: "The 3 kg load",
        words:
          "The button adds a load that the controller does not know, or removes it. Watch the position error.",
      },
      controller: {
        title: "FL or NDOBC",
        words:
          "FL cancels the model it knows; NDOBC also estimates the load and cancels it. Compare runs both at once.",
      },
      all: {
        title: "All controls",
        words:
          "This switch adds the reference, poles and gains, observer, non-ideal effects, more plots and their equations. The browser remembers it.",
      },
    },
  },
  equations: {
    open: (topic: string) => `Equation of ${topic}`,
    heading: (topic: string) => topic,
    number: (number: string) => `Eq ${number}`,
    here: "here",
    printed: "as published",
    corrected: "Corrected: the published form contains an error.",
    topics: {
      motion: "the motion",
      position: "position",
      error: "the position error",
      stiffness: "stiffness",
      stiffnessError: "the stiffness error",
      torque: "the torques",
      disturbance: "the disturbance and its estimate",
      deflection: "the deflection",
      phase: "the phase plane",
      controller: "the control laws",
      load: "the load",
    },
    notes: {
      lever:
        "The paper's text after Eq 5 has a = Rθ₂/2π, which agrees only for γ = 1, μ₀ = 0. Here γ = 1, and μ₀ makes σ(0) equal to its reference.",
      zeroStiffness:
        "Beyond this angle the stiffness is negative: 0.54 rad at σ = 15, 0.37 rad at σ = 150, below the paper's limit of 0.75 rad. The limit of a run therefore depends on μ.",
      signLaw:
        "The published sign drives the state out of the model's domain within 0.1 s; the opposite sign is correct. v = −Σ cₖ eₖ.",
      signError: "E contains the errors of q and σ, reference minus actual, and their derivatives.",
      observer:
        "J = (M, B₁, B₂), v the velocities, F the torques of the nominal model. β = k/J is the bandwidth of the estimate.",
      discrete:
        "Discrete form with period T. It uses both ends of each sample and the actual torque u, which prevents windup at the limits.",
      rest: "At rest under a constant w. Γ maps the disturbance to the highest derivative (Eq 24); c₀ is the product of the poles.",
      reaction:
        "The published form has the wrong sign and would create energy; this one is the gradient of the spring's energy V.",
      load: "The paper's 3 kg as published: 2 N·m on the link and on both motors.",
      mass: "A hanging mass adds inertia and gravity: 3 kg at 68 mm.",
      fade: "The reference and four derivatives are known; a change fades in without a jump in any of them.",
    },
  },
  claims: {
    heading: "Claims of the paper",
    explanation:
      "Runs the figure with both laws in a separate session as fast as possible and compares the result with the claim. Your session is not affected.",
    check: (figure: string) => `Check ${figure}`,
    running: (figure: string) => `Running ${figure}…`,
    failed: (why: string) => `The check did not finish. ${why}`,
    result: (figure: string) => `${figure}: claim of the paper and simulated result`,
    claim: "The paper",
    numbers: "Numbers of the run",
    quantity: "Quantity",
    rows: {
      before: "Error before the load, rms 1–5 s",
      peak: "Peak at the load, 5–7 s",
      steady: "Error under the load, rms 8–20 s",
      stiffness: "Stiffness error under the load, rms",
    },
    degrees: "deg",
    stiffnessUnit: "N·m/rad",
    curve: "Position error of FL and NDOBC over 20 s, logarithmic; the load is added at 5 s",
    loadMark: "3 kg",
    holds: "holds",
    holdsNot: "fails",
    holdsSign: "✓",
    holdsNotSign: "✕",
    overall: { holds: "The claim holds.", fails: "Parts of the claim do not hold." },
    parts: {
      alike_before: "Both laws track well before the load: below 0.1°",
      fl_poor: "FL tracks poorly under the load: more than ten times its error before",
      ndobc_goes_on: "The error of NDOBC under the load is at most twice its error before",
      stiffness_kept: "The load does not change NDOBC's stiffness error: below 0.01 N·m/rad",
      both_grow: "Position and stiffness error both grow with FL",
      ndobc_better: "Both errors of NDOBC are at least 100 times smaller",
    },
    sizes:
      "The paper gives neither gains nor torque limits: only the ranking of the laws can be confirmed, not the size of FL's error.",
  },
} as const;
