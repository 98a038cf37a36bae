/** The lanes of the session: which laws run side by side, and under which names. */
import { computed } from "@preact/signals";
import type { Law, SessionState } from "../api/types";
import { text } from "../text/en";
import { session } from "./session";

export const otherLaw = (law: Law): Law => (law === "fl" ? "ndobc" : "fl");

/** The controllers set beside the session's own; a bench's simulated twin is none of them. */
export const rivalsOf = ({ configuration: { rivals }, bench }: SessionState) =>
  bench === null ? rivals : rivals.slice(1);

export const lawsOf = ({ configuration: { law, rivals } }: SessionState): Law[] => [
  law,
  ...rivals.map((rival) => rival.law),
];

/** The laws by name; where two lanes have one law, with the number of the lane. A bench's
 * first two lanes are the bench itself and its simulated twin. */
function nameLanes(laws: readonly Law[], isBench = false): string[] {
  return laws.map((law, index) => {
    if (isBench && index < text.compare.bench.length) {
      return `${text.compare.bench[index]} ${text.controller[law]}`;
    }
    const isAlone = laws.filter((one) => one === law).length === 1;
    return isAlone ? text.controller[law] : text.compare.numbered(text.controller[law], index + 1);
  });
}

const SEPARATOR = ",";
/** A string, so that what depends on it is made anew only when a law changes. */
const lawsKey = computed(() =>
  session.value === null ? "" : lawsOf(session.value).join(SEPARATOR),
);

const isBench = computed(() => (session.value?.bench ?? null) !== null);

/** Names of lane 1, 2, …; the same array until a law changes. */
export const laneNames = computed(() =>
  nameLanes(lawsKey.value === "" ? [] : (lawsKey.value.split(SEPARATOR) as Law[]), isBench.value),
);
