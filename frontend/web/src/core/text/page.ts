/** The frame of the page: header, status bar, banners, login, and the advice after a fault. */

/** What to try after a fault, by its code; none where its message says all there is to do. */
const faultAdvice: Readonly<Record<string, string>> = {
  lever_end:
    "A load bends a soft spring far, and to hold the stiffness meanwhile the law turns the spiral far and fast; whether to its end depends on when in the motion the load comes. A torque on the stiffness motor itself can do it, too. Try a stiffer setting, a smaller load, a slower motion, slower stiffness poles and observer (Place poles), or a law that gives way when it asks for more than the motors have (NDOBC-W, NDOBC-S).",
  deflection_limit:
    "Beyond this angle the spring pushes the wrong way, and no law can bring it back. Try a stiffer setting, a smaller load, a slower motion, or a law that gives way when it asks for more than the motors have (NDOBC-W, NDOBC-S).",
  singular_decoupling:
    "A soft spring that is bent far answers both motors nearly alike: to move position and stiffness apart would take torques that no motor has. Try a stiffer setting, a smaller load or a slower motion.",
  not_finite:
    "Gains or bandwidths are too fast for the loop's rate, so that it grows without bound. Take the last ones back (Undo), or set slower ones (Place poles).",
  overspeed:
    "Something turned faster than the bench file allows. Try a smaller or slower motion or load, and slower poles and observer (Place poles).",
  overload:
    "Let the motor cool. Then try a smaller or slower motion, or a smaller load: its current was above what it bears for long.",
  vibration:
    "Poles or observer are too fast for what the encoders see and the drives follow. Try slower ones (Place poles).",
};

const heatAdvice =
  "From 90 % of the heat that its winding bears on (I²t), a motor gives less than the law asks for, so that it is not burnt; what was left did not hold the load, and the actuator went where the fault says. Gains and laws do not help. Let the motor cool (under Details stands its heat), then try a load that asks less of that motor, or take it off sooner.";
const HELD_BACK = /_held_to_nm$/;

/** A fault that came while heat held a motor back has that as its reason, whatever its code. */
export const adviceOn = (code: string, values: Readonly<Record<string, unknown>>): string | null =>
  Object.keys(values).some((name) => HELD_BACK.test(name))
    ? heatAdvice
    : (faultAdvice[code] ?? null);

export const pageText = {
  name: "SVSA Lab",
  skip: "Skip to the plots",
  subtitle: "variable stiffness, live",
  session: "Session",
  view: "The actuator in 3D",
  pages: {
    open: "Pages",
    openHint:
      "Learn, runs, ranking, leaderboard, studies, falsifier, tuning, and the documented routes",
    names: {
      lab: "Lab",
      learn: "Learn",
      runs: "Runs",
      ranking: "Ranking",
      leaderboard: "Leaderboard",
      grades: "Grades",
      studies: "Studies",
      falsifier: "Falsifier",
      tune: "Tune …",
      docs: "REST and stream",
    },
    hints: {
      lab: "The actuator, live",
      learn: "Exercises beside the live lab, the paper's claims, every equation, the tour",
      runs: "Recorded: look, compare, replay, export (O)",
      ranking: "Every law in the same scenarios: errors, faults, robustness",
      grades: "What was submitted, run again, and its points by criterion",
      leaderboard: "Your law among the lab's, on trials that nobody knows",
      studies: "Many perturbed runs of every law: how often they succeed, and what decides it",
      falsifier: "Search the load that hurts a law most, and put any law through it",
      tune: "Search a law's parameters on five training runs",
      docs: "What a script can do here, in a new tab",
    },
  },
  figures: {
    heading: "Paper",
    name: { "4a": "Fig. 4A", "4b": "Fig. 4B", "5": "Fig. 5" },
    does: {
      "4a": "Restart as in Figure 4A: 60° sine, stiffness 15 N·m/rad, 3 kg at 5 s",
      "4b": "Restart as in Figure 4B: 60° sine, stiffness 60 N·m/rad, 3 kg at 5 s",
      "5": "Restart as in Figure 5: 60° sine, stiffness varies around 35 N·m/rad, 3 kg at 5 s",
    },
  },
  transport: {
    heading: "Run the session",
    run: "Run",
    pause: "Pause",
    either: "Run / Pause",
    reset: "Reset",
    resetHint: "Back to time 0 with the present settings",
    step: "Step",
    stepHint: "Go on by a little while paused",
    stepLength: "Length of a step",
    milliseconds: (ms: number) => (ms < 1000 ? `${ms} ms` : `${ms / 1000} s`),
    speed: "Speed",
    speedHint: "Session time against wall time",
    times: (factor: number) => `${factor}×`,
    fastest: "max",
  },
  status: {
    running: "Running",
    paused: "Paused",
    fault: "Fault",
    time: "Session time",
    timeHint: "Session time, minutes and seconds",
    heading: "Status",
    loop: "Loop",
    rate: (hertz: number) => `${Number(hertz.toFixed(1))} Hz`,
    realTime: (factor: string) => `${factor}× real time`,
    standing: "standing still",
    unknown: "Unknown",
    notKnown: "not known",
    lastKnown: (state: string) => `Last known: ${state}`,
    rateHint: (stretched: string) =>
      `Control rate, and how fast session time passes; ${stretched} given up so far`,
    late: (median: string, most: string) => `late ${median} / ${most}`,
    skipped: (count: number) => `${count} ticks skipped`,
    lateHint:
      "Control rate; lateness of the ticks, half of them / 99 of 100, since it started; ticks left out of the present run",
    recording: "Recording",
    notRecording: "off",
    connection: "Connection",
  },
  connection: {
    connecting: "Connecting",
    live: "Live",
    lost: "Offline",
    locked: "Locked",
    ended: "Ended",
    waiting: "Waiting for the lab…",
    lostTitle: "The connection is lost.",
    lostText: "What the lab does now is unknown. The page reconnects by itself.",
    anotherTitle: "This is a new session.",
    anotherText:
      "The one shown before is over: its server was started anew, or it was ended. Settings are those of a beginning; what was recorded stands under Runs.",
    unreachable: "The server does not answer.",
    askingTitle: "No answer came.",
    askingText:
      "Whether the last command was carried out is unknown; the page is asking the server.",
    carriedOutTitle: "The last command was carried out.",
    carriedOutText: "Only its answer was lost.",
    doneUnseen: "This was carried out, but its answer was lost: reload the page to see it.",
    notCarriedOut: "The server did not get this: it was not carried out.",
    refused: (status: number) => `The server refused this (${status}): it was not carried out.`,
    stillUnknown:
      "No answer came, and whether this was carried out is still unknown. Look at the state before you do it again.",
    missed: (count: number) => `${count} skipped`,
    missedHint: "Samples left out because this browser could not keep up",
  },
  meanwhile: {
    changed: "Somebody else changed this meanwhile; yours was not taken.",
    now: (list: string) => `It is now: ${list}.`,
    shown: "What is set now is theirs.",
    law: (title: string) => `law ${title}`,
    value: (label: string, value: string) => `${label} ${value}`,
    again: "Set mine all the same",
  },
  login: {
    title: "This lab is locked",
    explanation: "Enter the secret that the lab was started with.",
    secret: "Secret",
    enter: "Enter",
  },
  fault: {
    title: (time: number) => `Stopped at ${time.toFixed(2)} s.`,
    adviceTitle: "Why this happens, and what to try",
    advice: adviceOn,
    reset: "Reset",
  },
  panel: { close: "Close" },
  recording: {
    start: "Record",
    startHint: "Record every sample and command from now on",
    stop: "Stop recording",
    unknown: "Recording: not known",
    running: "Recording",
    saving: "Saving the recording…",
    saved: "Saved:",
    savedPartly: "Saved, but it ended early:",
    savedUnknown: "The recording ended. Whether its file is finished is not known yet: see Runs.",
    open: "Open",
    failed: "The recording failed.",
    close: "Close",
  },
  theme: { toDark: "Dark theme", toLight: "Light theme" },
} as const;
