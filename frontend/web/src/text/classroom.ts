/** A class: join it, whose turn it is, who is here, the instructor's page. */
export const classroomText = {
  classroom: {
    title: "Join the class",
    explanation: "Your name is shown to everybody here.",
    code: "Class code",
    join: "Join",
    token: "Instructor token",
    asInstructor: "I am the instructor",
    asStudent: "I am a student",
    freeTitle: "Nobody is in control.",
    lockedTitle: "The instructor has locked control.",
    observerText: "You observe; you can pause and stop at any time.",
    waits: (name: string, count: number) =>
      count === 1
        ? `${name} waits for control.`
        : `${name} and ${count - 1} more wait for control.`,
    goesOn: (seconds: number) =>
      `It goes on by itself when you give no command for ${Math.round(seconds)} s.`,
    placeText: (place: number, count: number) =>
      place === 1 ? "You are next." : `You are number ${place} of ${count} who wait.`,
    handOver: (name: string) => `Hand over to ${name}`,
    open: "Class",
    openHint: "Who is here, who waits, and your own sessions",
    panelTitle: "The class",
    here: (count: number) => `Here: ${count}`,
    name: "Name",
    role: "Role",
    roles: { observer: "Observer", operator: "Student", instructor: "Instructor" },
    sees: "Sees",
    shared: "shared",
    you: "you",
    queue: "Waits for control",
    nobodyWaits: "Nobody waits.",
    give: (name: string) => `Give control to ${name}`,
    giveShort: "Give control",
    lock: "Lock control",
    unlock: "Unlock control",
    lockHint: "Nobody but you commands the shared session; who had control gets it back first",
    sessions: "Private sessions",
    noSessions: "None is open.",
    recording: "recording",
    openSession: (owner: string) => `Open the session of ${owner}`,
    openShort: "Open",
    end: (owner: string) => `End the session of ${owner}`,
    endShort: "End",
    broadcast: "Send the shared settings to everybody",
    broadcastHint:
      "Law, gains, observer and references of the shared session, into every private one",
    sent: (count: number, refused: number) =>
      refused === 0
        ? `Taken by ${count} sessions.`
        : `Taken by ${count} sessions, refused by ${refused}.`,
    newCode: "New class code",
    newCodeHint: "The old code lets nobody in any more; who has joined stays",
    codeOnce: "Shown once. Students scan it, or type the code:",
    onlyHere:
      "Only this machine reaches the lab: start it with --host auto, so that others can join",
    qr: (code: string) => `QR code of the address to join with the code ${code}`,
    runs: "All runs of the class",
    script: "Token for a script",
    scriptHint: "A script with it is you: it asks for control like you",
    scriptOnce: "Shown once. Put it into the environment of the script, as SVSA_SECRET:",
    leave: "Leave the class",
  },
} as const;
