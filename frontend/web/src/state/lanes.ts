/** The lanes of the session: which laws run side by side, and under which names. */
import { computed } from "@preact/signals";
import type { Law, SessionState } from "../api/types";
import { nameLanes } from "../lanenames";
import { session } from "./session";

export const otherLaw = (law: Law): Law => (law === "fl" ? "ndobc" : "fl");

/** The controllers set beside the session's own; a bench's simulated twin is none of them. */
export const rivalsOf = ({ configuration: { rivals }, bench }: SessionState) =>
  bench === null ? rivals : rivals.slice(1);

export const lawsOf = ({ configuration: { law, rivals } }: SessionState): Law[] => [
  law,
  ...rivals.map((rival) => rival.law),
];

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
