/** What helps to understand: the tour, the equations, the paper's claims. */
export const learningText = {
  learning: {
    open: "Learn",
    openHint: "Exercises beside the live lab, the paper's claims, every equation, the tour",
    title: "Learn",
    lead: "Predict, run, explain: seven exercises beside the live lab, from the lever to a law of your own. What you foretell is kept before you see the run, and the run judges it.",
    equations: "Equations",
    equationsHint: "Each stands behind its symbol on the page too.",
  },
  lesson: {
    exercises: "Exercises",
    all: "All exercises",
    loading: "Loading…",
    exercise: (number: number) => `Exercise ${number}`,
    label: (title: string) => `Exercise: ${title}`,
    minutes: (minutes: number) => `${minutes} min`,
    points: (points: number) => (points === 1 ? "1 point" : `${points} points`),
    begin: "Begin",
    goOn: "Go on",
    look: "Look again",
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
    keep: "Keep it",
    change: "Change it",
    kept: (answer: string, unit: string) => `You predicted ${answer}${unit && ` ${unit}`}.`,
    keptHint: "You may change it until the run that judges it is set up.",
    isKept: "The run has been set up: it stays.",
    choose: "Choose",
    chosenOnce: "You choose once: the answer tells which is right.",
    setUp: "Set up",
    setUpAndRun: "Set up and run",
    again: "Run again",
    run: "Run and record",
    setUpHint: "Sets this session to what the step asks for, at time 0",
    runHint: "From time 0 with what is set now, recorded to the end",
    free: (what: string) => `Yours to choose, in the settings: ${what}.`,
    freeNames: {
      law: "law",
      comparisons: "lanes beside",
      gains: "gains",
      parameters: "parameters of the law",
      observer: "observer",
      stiffness: "stiffness",
      position: "motion",
      effects: "realism",
    } as Readonly<Record<string, string>>,
    asked: "What the run is asked for",
    seconds: (now: number, end: number) =>
      `Running: ${Math.min(now, end).toFixed(1)} of ${end} s, then it is judged.`,
    judging: "The run is being judged…",
    predictFirst: (step: string) => `Predict first: ${step}`,
    results: "What came of it",
    right: "Right",
    partly: "Partly",
    wrong: "Not yet",
    show: (time: string) => `Look there, ${time} s`,
    showHint: "The plots stand still around that moment; older runs are opened in replay",
    missing: "Still to be done:",
    name: "Your name",
    law: {
      label: "Your law",
      start: "Begin with the law above",
      try: "Try it and keep it",
      tryHint: "It runs in a process of its own, on a scenario that everybody may see",
      trying: "It is being tried, for some seconds…",
      verdicts: {
        held: "It holds",
        ran: "It goes to the end",
        ended: "The run ended early",
        failed: "It fails",
        untried: "Kept, not tried",
      },
      output: "What it printed",
      changed: "What stands above is not the law that is kept: try it, or it is not submitted.",
      tryFirst: "Your law: try it, and it is kept.",
      later: (points: number) =>
        `The law has up to ${points} points more. They are given when it is graded, on scenarios that are drawn from what you submitted.`,
    },
    submit: "Submit",
    submitHint: "Once. After it nothing of the exercise is changed any more.",
    held: (name: string) => `${name} is in control of this session.`,
    nobody: "Nobody is in control of this session.",
    ask: "Ask for control",
    apart: "Work in a session of your own",
    apartHint: "A private simulated session, which only you command",
    simulatedOnly:
      "A bench has its own plant and effects: this step runs in a simulated session of your own.",
    before: "Before it runs:",
    above: "The bench's buttons are at the top of the page.",
    handsEmulated: "The emulator hangs the load by itself.",
    hands: (what: string, hands: readonly { time_s: number; is_on: boolean }[]) =>
      `By hand at the bench: ${what}; ${hands
        .map(({ time_s: at, is_on: isOn }) => `${isOn ? "on" : "off"} at ${at} s`)
        .join(", ")}. Keep clear of the link before and after.`,
    handAt: (what: string, isOn: boolean, at: number) =>
      isOn ? `At ${at} s by hand: ${what}.` : `At ${at} s by hand: take it off.`,
    handNow: (what: string, isOn: boolean) =>
      isOn ? `Now by hand: ${what}.` : "Now by hand: take it off.",
    cut: {
      control: (time: string) => `You lost control at ${time} s, in the middle of the run.`,
      stopped: (time: string) => `The bench was stopped at ${time} s, before the run's end.`,
    },
    cutAgain: "It is not judged: begin the step again.",
  },
  tour: {
    label: "Tour of the lab",
    take: "Take the tour",
    skip: "Skip",
    next: "Next",
    back: "Back",
    done: "Done",
    of: (step: number, all: number) => `${step} of ${all}`,
    keys: "Arrows go on and back, Esc skips.",
    steps: {
      welcome: {
        title: "Welcome to the lab",
        words:
          "One motor moves a link through a spring; a second motor changes how stiff that spring is. See it in six short steps.",
      },
      view: {
        title: "The actuator",
        words:
          "White is the link, pale where it should be. Blue is the principal motor, brass the stiffness motor; the spring turns from blue to red as it stiffens.",
      },
      plots: {
        title: "What happens",
        words:
          "Dotted is the reference, solid the chosen controller. If it follows well, you see one line. The symbol next to a title opens its equation.",
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
      gains: {
        title: "Gains without fear",
        words:
          "Place the poles with the mouse. The page says what they would do before they are applied, and Undo takes them back.",
      },
    },
  },
  equations: {
    open: (topic: string) => `Equation of ${topic}`,
    heading: (topic: string) => topic,
    number: (number: string) => `Eq ${number}`,
    here: "here",
    printed: "as printed",
    corrected: "The paper prints it otherwise; this is the form that holds.",
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
        "The paper's text after Eq 5 has a = Rθ₂/2π, which agrees only for γ = 1, μ₀ = 0. Here γ = 1, and μ₀ makes σ(0) = σ_d(0).",
      zeroStiffness:
        "Beyond this angle the stiffness is negative. It is 0.54 rad at σ = 15 and 0.37 rad at 150, well inside the paper's 0.75 rad: the limit of a run depends on μ.",
      signLaw:
        "The printed sign leaves the domain of the model within 0.1 s; the opposite one is right. v = −Σ cₖ eₖ.",
      signError: "E holds the errors q_d − q, σ_d − σ and their derivatives.",
      observer:
        "J = (M, B₁, B₂), v the velocities, F the torques of the nominal model. β = k/J is how fast the estimate follows.",
      discrete:
        "As it runs, with period T: both ends of each sample, and the torque u really applied, so that it does not wind up at the limits.",
      rest: "At rest under a constant w. Γ is what the disturbance does to the highest derivative (Eq 24); c₀ is the product of the poles.",
      reaction:
        "The printed form is a force of the wrong sign, and would create energy; this one is the slope of the spring's energy V.",
      load: "The paper's 3 kg as it is printed: 2 N·m on the link and on both motors.",
      mass: "What hanging a mass does: it adds inertia and gravity, 3 kg at 68 mm.",
      fade: "q_d and four derivatives of it are known; a change fades over without a jump in any of them.",
    },
  },
  claims: {
    heading: "Does the paper hold?",
    explanation:
      "Runs the figure with both laws in a session of its own, as fast as it goes, and lays the outcome beside the claim. Your session goes on untouched.",
    check: (figure: string) => `Check ${figure}`,
    running: (figure: string) => `Running ${figure}…`,
    failed: (why: string) => `The check did not finish. ${why}`,
    result: (figure: string) => `${figure}: what the paper claims, and what came out`,
    claim: "The paper",
    numbers: "Numbers of the run",
    quantity: "Quantity",
    rows: {
      before: "Error before the load, rms 1–5 s",
      peak: "Peak at the load, 5–7 s",
      steady: "Error after it, rms 8–20 s",
      stiffness: "Stiffness error after it, rms",
    },
    degrees: "deg",
    stiffnessUnit: "N·m/rad",
    curve: "Position error of FL and NDOBC over 20 s, logarithmic; the load comes at 5 s",
    loadMark: "3 kg",
    holds: "holds",
    holdsNot: "does not hold",
    holdsSign: "✓",
    holdsNotSign: "✕",
    overall: { holds: "The claim holds.", fails: "Not all of the claim holds." },
    parts: {
      alike_before: "Both laws track well before the load: below 0.1°",
      fl_poor: "FL tracks poorly after it: more than ten times its error before",
      ndobc_goes_on: "NDOBC goes on: back to its error before, within a factor of two",
      stiffness_kept: "NDOBC's stiffness error is unmoved by the load: below 0.01 N·m/rad",
      both_grow: "Position and stiffness error both grow with FL",
      ndobc_better: "NDOBC stays better in both: at least 100 times",
    },
    sizes:
      "The paper gives neither gains nor limits, so the size of FL's error confirms no figure; the order does.",
  },
} as const;
