/** The lanes of the session: what runs side by side, and under which names. */
import { computed } from "@preact/signals";
import type { Law, SessionState } from "../api/types";
import { session } from "./session";

export const otherLaw = (law: Law): Law => (law === "fl" ? "ndobc" : "fl");

/** The controllers set beside the session's own; a bench's simulated twin is none of them. */
export const rivalsOf = ({ configuration: { rivals }, bench }: SessionState) =>
  bench === null ? rivals : rivals.slice(1);

const SEPARATOR = "\n";
/** A string, so that what depends on it is made anew only when a name changes. */
const namesKey = computed(() =>
  (session.value?.lanes ?? []).map(({ name }) => name).join(SEPARATOR),
);

/** Names of lane 1, 2, …; the same array until one changes. */
export const laneNames = computed(() =>
  namesKey.value === "" ? [] : namesKey.value.split(SEPARATOR),
);
