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
      none: "Without an estimate of the load",
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
} as const;
