/** Where the reader is: the lab, the arena, a study, the list of runs, one run at a moment, or several laid over. */
import { signal } from "@preact/signals";

/** What of a study is looked at: axes, metric, brush, each by its name in the address. */
export type Look = Readonly<Record<string, string>>;

export type Place =
  | { kind: "lab" }
  | { kind: "arena" }
  | { kind: "studies"; study: string; look: Look }
  | { kind: "list" }
  | { kind: "run"; run: string; timeS: number }
  | { kind: "overlay"; runs: readonly string[] };

/** Places that are recorded runs. */
export type RunsPlace = Exclude<Place, { kind: "lab" | "arena" | "studies" }>;

const LOOK = ["sx", "sy", "tx", "ty", "metric", "law", "brush"] as const;
const PARTS = ["arena", "runs", "run", "t", "overlay", "studies", ...LOOK] as const;
const EVERY = "all";
const SEPARATOR = ",";

/** Reads a query such as "?run=20260102-030405-9f8e7d6c&t=12.3". */
export function readPlace(query: string): Place {
  const parts = new URLSearchParams(query);
  const run = parts.get("run");
  if (run) {
    const timeS = Number(parts.get("t") ?? 0);
    return { kind: "run", run, timeS: Number.isFinite(timeS) && timeS > 0 ? timeS : 0 };
  }
  const runs = (parts.get("overlay") ?? "").split(SEPARATOR).filter((id) => id !== "");
  if (runs.length > 0) return { kind: "overlay", runs };
  if (parts.has("arena")) return { kind: "arena" };
  const study = parts.get("studies");
  if (study !== null) {
    const said = LOOK.map((part): [string, string] => [part, parts.get(part) ?? ""]);
    const look = Object.fromEntries(said.filter(([, value]) => value !== ""));
    return { kind: "studies", study: study === EVERY ? "" : study, look };
  }
  return { kind: parts.has("runs") ? "list" : "lab" };
}

/** The query of a place; what else the address says stays. */
export function writePlace(place: Place, query: string): string {
  const parts = new URLSearchParams(query);
  for (const part of PARTS) parts.delete(part);
  if (place.kind === "arena") parts.set("arena", "all");
  if (place.kind === "studies") {
    parts.set("studies", place.study || EVERY);
    for (const part of LOOK) if (place.look[part]) parts.set(part, place.look[part]);
  }
  if (place.kind === "list") parts.set("runs", "all");
  if (place.kind === "overlay") parts.set("overlay", place.runs.join(SEPARATOR));
  if (place.kind === "run") {
    parts.set("run", place.run);
    if (place.timeS > 0) parts.set("t", String(Number(place.timeS.toFixed(3))));
  }
  const text = parts.toString().replaceAll("%2C", SEPARATOR);
  return text === "" ? "" : `?${text}`;
}

export const isOfRuns = (at: Place): at is RunsPlace =>
  at.kind !== "lab" && at.kind !== "arena" && at.kind !== "studies";

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

export function toggleRuns(): void {
  goTo({ kind: isOfRuns(place.peek()) ? "lab" : "list" });
}

export function followHistory(): void {
  window.addEventListener("popstate", () => {
    place.value = readPlace(location.search);
  });
}
