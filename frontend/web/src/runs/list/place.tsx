/** The present page: lab, exercise, actuators, ranking, leaderboard, grades, study, search, runs, one run at a time, overlay. */
import { signal } from "@preact/signals";
import type { ComponentChildren } from "preact";

/** What of a study is looked at: axes, metric, brush, each by its name in the address. */
type Look = Readonly<Record<string, string>>;

export type Place =
  | { kind: "lab" }
  | { kind: "learn"; exercise: string; step: string }
  | { kind: "actuators"; actuator: string }
  | { kind: "ranking" }
  | { kind: "leaderboard"; entry: string }
  | { kind: "grades" }
  | { kind: "studies"; study: string; look: Look }
  | { kind: "falsifier"; search: string; scenario: string; laws: readonly string[] }
  | { kind: "list" }
  | { kind: "run"; run: string; timeS: number }
  | { kind: "overlay"; runs: readonly string[] };

/** Places that are recorded runs. */
export type RunsPlace = Exclude<
  Place,
  {
    kind:
      | "lab"
      | "learn"
      | "actuators"
      | "ranking"
      | "leaderboard"
      | "grades"
      | "studies"
      | "falsifier";
  }
>;

const LOOK = ["sx", "sy", "tx", "ty", "metric", "law", "brush"] as const;
const SEARCH = ["falsifier", "scenario", "laws"] as const;
const PARTS = [
  "learn",
  "actuators",
  "ranking",
  "leaderboard",
  "grades",
  "runs",
  "run",
  "t",
  "overlay",
  "studies",
  ...LOOK,
  ...SEARCH,
] as const;
const EVERY = "all";
const SEPARATOR = ",";
const STEP_SEPARATOR = "/";

const splitNames = (said: string | null): string[] =>
  (said ?? "").split(SEPARATOR).filter((name) => name !== "");

/** Reads a query such as "?run=20260102-030405-9f8e7d6c&t=12.3". */
export function readPlace(query: string): Place {
  const parts = new URLSearchParams(query);
  const run = parts.get("run");
  if (run) {
    const timeS = Number(parts.get("t") ?? 0);
    return { kind: "run", run, timeS: Number.isFinite(timeS) && timeS > 0 ? timeS : 0 };
  }
  const runs = splitNames(parts.get("overlay"));
  if (runs.length > 0) return { kind: "overlay", runs };
  const learn = parts.get("learn");
  if (learn !== null) {
    const [exercise = "", step = ""] = learn === EVERY ? [] : learn.split(STEP_SEPARATOR);
    return { kind: "learn", exercise, step };
  }
  const actuator = parts.get("actuators");
  if (actuator !== null) return { kind: "actuators", actuator: actuator === EVERY ? "" : actuator };
  if (parts.has("ranking")) return { kind: "ranking" };
  if (parts.has("grades")) return { kind: "grades" };
  const entry = parts.get("leaderboard");
  if (entry !== null) return { kind: "leaderboard", entry: entry === EVERY ? "" : entry };
  const study = parts.get("studies");
  if (study !== null) {
    const said = LOOK.map((part): [string, string] => [part, parts.get(part) ?? ""]);
    const look = Object.fromEntries(said.filter(([, value]) => value !== ""));
    return { kind: "studies", study: study === EVERY ? "" : study, look };
  }
  const search = parts.get("falsifier");
  if (search !== null) {
    return {
      kind: "falsifier",
      search: search === EVERY ? "" : search,
      scenario: parts.get("scenario") ?? "",
      laws: splitNames(parts.get("laws")),
    };
  }
  return { kind: parts.has("runs") ? "list" : "lab" };
}

/** The query of a place; what else the address says stays. */
export function writePlace(place: Place, query: string): string {
  const parts = new URLSearchParams(query);
  for (const part of PARTS) parts.delete(part);
  if (place.kind === "learn") {
    const named = [place.exercise, place.step].filter((part) => part !== "");
    parts.set("learn", named.join(STEP_SEPARATOR) || EVERY);
  }
  if (place.kind === "actuators") parts.set("actuators", place.actuator || EVERY);
  if (place.kind === "ranking") parts.set("ranking", "all");
  if (place.kind === "grades") parts.set("grades", EVERY);
  if (place.kind === "leaderboard") parts.set("leaderboard", place.entry || EVERY);
  if (place.kind === "studies") {
    parts.set("studies", place.study || EVERY);
    for (const part of LOOK) if (place.look[part]) parts.set(part, place.look[part]);
  }
  if (place.kind === "falsifier") {
    parts.set("falsifier", place.search || EVERY);
    if (place.scenario !== "") parts.set("scenario", place.scenario);
    if (place.laws.length > 0) parts.set("laws", place.laws.join(SEPARATOR));
  }
  if (place.kind === "list") parts.set("runs", "all");
  if (place.kind === "overlay") parts.set("overlay", place.runs.join(SEPARATOR));
  if (place.kind === "run") {
    parts.set("run", place.run);
    if (place.timeS > 0) parts.set("t", String(Number(place.timeS.toFixed(3))));
  }
  const text = parts.toString().replaceAll("%2C", SEPARATOR).replaceAll("%2F", STEP_SEPARATOR);
  return text === "" ? "" : `?${text}`;
}

export const isOfRuns = (at: Place): at is RunsPlace =>
  at.kind === "list" || at.kind === "run" || at.kind === "overlay";

/** The live session is shown: alone, or next to an exercise. */
export const isOfLab = (at: Place): boolean =>
  at.kind === "lab" || (at.kind === "learn" && at.exercise !== "");

export const place = signal<Place>(readPlace(location.search));

export const linkTo = (next: Place): string =>
  location.pathname + writePlace(next, location.search);

export function goTo(next: Place): void {
  history.pushState(null, "", linkTo(next));
  place.value = next;
}

/** Puts the moment into the address, so that the address is a link to it. */
export function keepMoment(run: string, timeS: number): void {
  const now = place.peek();
  if (now.kind !== "run" || now.run !== run) return;
  history.replaceState(null, "", linkTo({ kind: "run", run, timeS }));
}

/** Puts what is looked at into the address, so that the address is a link to it. */
export function keepLook(look: Look): void {
  const now = place.peek();
  if (now.kind !== "studies") return;
  const next = { ...now, look };
  history.replaceState(null, "", linkTo(next));
  place.value = next;
}

/** Writes the laws of a scenario into the address. */
export function keepLaws(laws: readonly string[]): void {
  const now = place.peek();
  if (now.kind !== "falsifier") return;
  const next = { ...now, laws };
  history.replaceState(null, "", linkTo(next));
  place.value = next;
}

export function toggleRuns(): void {
  goTo({ kind: isOfRuns(place.peek()) ? "lab" : "list" });
}

export function followHistory(): void {
  window.addEventListener("popstate", () => {
    place.value = readPlace(location.search);
  });
}

interface PlaceLinkProps {
  to: Place;
  class?: string;
  title?: string;
  /** It leads to the page that is shown. */
  isHere?: boolean;
  /** The key that does the same, in the words of `aria-keyshortcuts`. */
  shortcut?: string | undefined;
  /** After a click that stayed on the page. */
  onGo?: () => void;
  children: ComponentChildren;
}

/** A true link, which a new tab takes too; a plain click stays on the page. */
export function PlaceLink({ to, isHere, shortcut, onGo, children, ...rest }: PlaceLinkProps) {
  return (
    <a
      href={linkTo(to)}
      aria-current={isHere ? "page" : undefined}
      aria-keyshortcuts={shortcut}
      {...rest}
      onClick={(event) => {
        if (event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey) return;
        event.preventDefault();
        goTo(to);
        onGo?.();
      }}
    >
      {children}
    </a>
  );
}
