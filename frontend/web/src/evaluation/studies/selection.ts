/** The studies of this lab, the selected one, its selected runs, and its view in the address. */
import { computed, signal } from "@preact/signals";
import type { Study, StudyList, StudyRow } from "../../core/api/studies";
import { place, storeStudyView } from "../../runs/list/place";
import { chooseAxes, type PlaneBrush, readBrush, writeBrush } from "./studyview";

export const list = signal<StudyList | null>(null);
export const study = signal<Study | null>(null);
/** The selected run, after the previously selected one, which is kept for an overlay. */
export const selectedRows = signal<readonly StudyRow[]>([]);

export const view = computed(() => (place.value.kind === "studies" ? place.value.look : {}));
/** The study that the address names, else the newest one; before the first the example. */
export const chosenName = computed(() => {
  const named = place.value.kind === "studies" ? place.value.study : "";
  return named || (list.value?.saved[0]?.name ?? "");
});
export const axes = computed((): Record<string, string> => {
  const columns = study.value?.columns ?? [];
  const known = Object.entries(view.value).filter(
    ([part, name]) => part !== "law" && columns.some((column) => column.name === name),
  );
  return { ...chooseAxes(columns), ...Object.fromEntries(known) };
});
/** The law whose runs the planes and the map show, or "" for all; by default the first. */
export const shownLaw = computed(() => {
  const laws = study.value?.laws ?? [];
  const requested = view.value.law ?? laws[0] ?? "";
  return laws.includes(requested) ? requested : "";
});
export const EVERY_LAW = "every";
export const brush = computed(() => readBrush(view.value.brush ?? ""));

export const setView = (changed: Readonly<Record<string, string>>): void =>
  storeStudyView(chosenName.peek(), { ...view.peek(), ...changed });
export const setBrush = (next: PlaneBrush | null): void =>
  setView({ brush: next === null ? "" : writeBrush(next) });
