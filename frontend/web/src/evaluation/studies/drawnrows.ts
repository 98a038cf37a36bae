/** The rows as drawn: values on screen, brush, colors, law. */
import { computed } from "@preact/signals";
import type { StudyColumn } from "../../core/api/studies";
import { lineStylesOfLaws } from "../../core/plots/linestyles";
import type { Axis } from "./frame";
import { markBrushed, scaleOf, spreadNames, spreadsByRatios } from "./points";
import { type Rows, valuesOf } from "./rows";
import { axes, brush, shownLaw, study } from "./selection";
import { rows } from "./studies";
import { factorOf, nameColumn, type Plane } from "./studyview";

export const columnOf = (name: string): StudyColumn | undefined =>
  study.value?.columns.find((column) => column.name === name);

/** Values on screen; categories jittered around their positions. */
export function screenValues(studyRows: Rows, name: string): Float64Array {
  const column = studyRows.columns.get(name);
  if (column === undefined) return new Float64Array(studyRows.count).fill(Number.NaN);
  if (column.labels !== null) return spreadNames(column.values);
  const factor = factorOf(columnOf(name)?.unit ?? "");
  return factor === 1 ? column.values : column.values.map((value) => value * factor);
}

function buildAxis(studyRows: Rows, name: string, values: Float64Array): Axis {
  const column = columnOf(name);
  const labels = studyRows.columns.get(name)?.labels ?? null;
  const wantsLog = column?.is_log || (column?.role === "metric" && spreadsByRatios(values));
  const { span, isLog } = scaleOf(values, labels === null && wantsLog === true);
  return { label: column ? nameColumn(column) : name, span, isLog, labels };
}

const buildPlane = (plane: Plane) =>
  computed(() => {
    const studyRows = rows.value;
    const [xName, yName] = [axes.value[`${plane}x`] ?? "", axes.value[`${plane}y`] ?? ""];
    const [x, y] = [screenValues(studyRows, xName), screenValues(studyRows, yName)];
    return { x, y, across: buildAxis(studyRows, xName, x), up: buildAxis(studyRows, yName, y) };
  });

export const planes = { s: buildPlane("s"), t: buildPlane("t") } as const;

export const marks = computed(() => {
  const activeBrush = brush.value;
  const { x, y } = planes[activeBrush?.plane ?? "s"].value;
  return markBrushed(x, y, activeBrush);
});

export const brushedCount = computed(() => marks.value.reduce((sum, mark) => sum + mark, 0));

/** 1 for a run that ended in a fault. */
export const endedInFault = computed(() =>
  Uint8Array.from(valuesOf(rows.value, "fault"), (code) => (Number.isNaN(code) ? 0 : 1)),
);
export const succeeded = computed(() => valuesOf(rows.value, "succeeded"));

/** Index of each run's law in the study. */
export const lawIndices = computed(() => {
  const column = rows.value.columns.get("law");
  const order = study.value?.laws ?? [];
  const places = (column?.labels ?? []).map((law) => order.indexOf(law));
  return (column?.values ?? new Float64Array(0)).map((code) => places[code] ?? 0);
});

/** The line styles of the laws of the study, in its order. */
export const lawLineStyles = computed(() => lineStylesOfLaws(study.value?.laws ?? []));

/**
 * The brushed runs of the law that is shown: with the same sample, dots of several laws coincide.
 */
export const shownMarks = computed(() => {
  const place = study.value?.laws.indexOf(shownLaw.value) ?? -1;
  return place < 0 ? marks.value : marksOf(place);
});

/** The marks of one law's runs only. */
export const marksOf = (place: number): Uint8Array => {
  const laws = lawIndices.value;
  return marks.value.map((mark, index) => (laws[index] === place ? mark : 0));
};
