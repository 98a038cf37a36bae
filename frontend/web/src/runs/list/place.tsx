/** The current page: lab, exercise, actuators, ranking, leaderboard, grades, study, search, runs, one run at a time, overlay. */
import { signal } from "@preact/signals";
import type { ComponentChildren } from "preact";

/** View of a study: axes, metric, brush, each by its name in the address. */
type StudyView = Readonly<Record<string, string>>;

export type Place =
  | { kind: "lab" }
  | { kind: "learn"; exercise: string; step: string }
  | { kind: "actuators"; actuator: string }
  | { kind: "ranking" }
  | { kind: "leaderboard"; entry: string }
  | { kind: "grades" }
  | { kind: "studies"; study: string; look: StudyView }
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

const STUDY_VIEW_PARTS = ["sx", "sy", "tx", "ty", "metric", "law", "brush"] as const;
const SEARCH_PARTS = ["falsifier", "scenario", "laws"] as const;
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
  ...STUDY_VIEW_PARTS,
  ...SEARCH_PARTS,
] as const;
const ALL = "all";
const SEPARATOR = ",";
const STEP_SEPARATOR = "/";

const splitNames = (text: string | null): string[] =>
  (text ?? "").split(SEPARATOR).filter((name) => name !== "");

/** Read a query such as "?run=20260102-030405-9f8e7d6c&t=12.3". */
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
    const [exercise = "", step = ""] = learn === ALL ? [] : learn.split(STEP_SEPARATOR);
    return { kind: "learn", exercise, step };
  }
  const actuator = parts.get("actuators");
  if (actuator !== null) return { kind: "actuators", actuator: actuator === ALL ? "" : actuator };
  if (parts.has("ranking")) return { kind: "ranking" };
  if (parts.has("grades")) return { kind: "grades" };
  const entry = parts.get("leaderboard");
  if (entry !== null) return { kind: "leaderboard", entry: entry === ALL ? "" : entry };
  const study = parts.get("studies");
  if (study !== null) {
    const entries = STUDY_VIEW_PARTS.map((part): [string, string] => [part, parts.get(part) ?? ""]);
    const look = Object.fromEntries(entries.filter(([, value]) => value !== ""));
    return { kind: "studies", study: study === ALL ? "" : study, look };
  }
  const search = parts.get("falsifier");
  if (search !== null) {
    return {
      kind: "falsifier",
      search: search === ALL ? "" : search,
      scenario: parts.get("scenario") ?? "",
      laws: splitNames(parts.get("laws")),
    };
  }
  return { kind: parts.has("runs") ? "list" : "lab" };
}

/** The query of a place; other parameters of the address stay. */
export function writePlace(place: Place, query: string): string {
  const parts = new URLSearchParams(query);
  for (const part of PARTS) parts.delete(part);
  if (place.kind === "learn") {
    const named = [place.exercise, place.step].filter((part) => part !== "");
    parts.set("learn", named.join(STEP_SEPARATOR) || ALL);
  }
  if (place.kind === "actuators") parts.set("actuators", place.actuator || ALL);
  if (place.kind === "ranking") parts.set("ranking", "all");
  if (place.kind === "grades") parts.set("grades", ALL);
  if (place.kind === "leaderboard") parts.set("leaderboard", place.entry || ALL);
  if (place.kind === "studies") {
    parts.set("studies", place.study || ALL);
    for (const part of STUDY_VIEW_PARTS) if (place.look[part]) parts.set(part, place.look[part]);
  }
  if (place.kind === "falsifier") {
    parts.set("falsifier", place.search || ALL);
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

export const isRunsPlace = (at: Place): at is RunsPlace =>
  at.kind === "list" || at.kind === "run" || at.kind === "overlay";

/** The live session is shown: alone, or next to an exercise. */
export const isLabShown = (at: Place): boolean =>
  at.kind === "lab" || (at.kind === "learn" && at.exercise !== "");

export const place = signal<Place>(readPlace(location.search));

export const linkTo = (next: Place): string =>
  location.pathname + writePlace(next, location.search);

export function goTo(next: Place): void {
  history.pushState(null, "", linkTo(next));
  place.value = next;
}

/** Store the moment in the address, so that the address is a link to it. */
export function storeMoment(run: string, timeS: number): void {
  const now = place.peek();
  if (now.kind !== "run" || now.run !== run) return;
  history.replaceState(null, "", linkTo({ kind: "run", run, timeS }));
}

/** Store the study and its view in the address, so that the address is a link to it. */
export function storeStudyView(study: string, look: StudyView): void {
  const now = place.peek();
  if (now.kind !== "studies") return;
  const next = { ...now, study, look };
  history.replaceState(null, "", linkTo(next));
  place.value = next;
}

/** Writes a scenario, or a search, with its laws into the address. */
export function storeLaws(
  shown: { search: string; scenario: string },
  laws: readonly string[],
): void {
  const now = place.peek();
  if (now.kind !== "falsifier") return;
  const next = { ...now, ...shown, laws };
  history.replaceState(null, "", linkTo(next));
  place.value = next;
}

export function toggleRuns(): void {
  goTo({ kind: isRunsPlace(place.peek()) ? "lab" : "list" });
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

/** A real link, which can be opened in a new tab; a plain click stays on the page. */
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
