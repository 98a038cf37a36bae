/** What helps to understand: the tour, the equations, the paper's claims. */
export const learningText = {
  learning: {
    open: "Learn",
    openHint: "The paper's figures checked, every equation, the tour",
    title: "Learn",
    equations: "Equations",
    equationsHint: "Each stands behind its symbol on the page too.",
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
          "Dashed is what was asked for, solid what happened. On a good run you see one line. The symbol beside a title opens its equation.",
      },
      load: {
        title: "Hang 3 kg",
        words:
          "This is the experiment: a load that the controller knows nothing of. Watch the position error.",
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
      alikeBefore: "Both laws track well before the load: below 0.1°",
      flPoor: "FL tracks poorly after it: more than ten times its error before",
      ndobcGoesOn: "NDOBC goes on: back to its error before, within a factor of two",
      stiffnessKept: "NDOBC's stiffness error is unmoved by the load: below 0.01 N·m/rad",
      bothGrow: "Position and stiffness error both grow with FL",
      ndobcBetter: "NDOBC stays better in both: at least 100 times",
    },
    partNumbers: (first: string, second: string) => `${first} and ${second}`,
    sizes:
      "The paper gives neither gains nor limits, so the size of FL's error confirms no figure; the order does.",
  },
} as const;
