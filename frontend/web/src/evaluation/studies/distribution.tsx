import { useMemo } from "preact/hooks";
import { otherAxis } from "../../core/plots/axes";
import { drawnCurve, type StaticChart, useStaticChart } from "../../core/plots/staticchart";
import { t } from "../../core/text/t";
import { columnOf, endedInFault, lawLineStyles, marks, marksOf, screenValues } from "./drawnrows";
import { distribute, extentOf, scaleOf, spreadsByRatios } from "./points";
import { ColumnChoice } from "./scatter";
import { axes, brush, study } from "./selection";
import { rows } from "./studies";
import { nameColumn } from "./studyview";
import { LawName } from "./tables";

const POINTS = 240;

/** Positions on the axis of the metric, linear or logarithmic. */
function placeLimits(values: Float64Array): { at: number[]; isLog: boolean } {
  const { isLog } = scaleOf(values, spreadsByRatios(values));
  const extent = extentOf(values);
  if (extent === null) return { at: [0, 1], isLog: false };
  const { low, high } = extent;
  const at = Array.from({ length: POINTS + 1 }, (_, index) => {
    const share = index / POINTS;
    return isLog ? low * (high / low) ** share : low + (high - low || 1) * share;
  });
  at[POINTS] = Math.max(high, at[POINTS - 1] as number);
  return { at, isLog };
}

/** Cumulative distribution of each law's brushed runs. */
export function Distribution() {
  const metric = axes.value.metric ?? "";
  const values = screenValues(rows.value, metric);
  const laws = study.value?.laws ?? [];
  const lineStyles = lawLineStyles.value;
  const held = marks.value;
  const { at, isLog } = placeLimits(values);
  const curves = laws.map((_, place) => distribute(values, endedInFault.value, marksOf(place), at));
  const column = columnOf(metric);
  const chart = useMemo(
    (): StaticChart => ({
      look: {
        padding: [8, 12, 0, 0],
        scales: { x: { time: false, distr: isLog ? 3 : 1 }, y: { range: () => [0, 102] } },
        axes: [otherAxis("x", { isLog }), otherAxis("y", { label: t("studies.below") })],
        series: [{}, ...lineStyles.map((lineStyle) => drawnCurve({ ...lineStyle, width: 2 }))],
      },
      data: [at, ...curves],
    }),
    [rows.value, metric, held, lineStyles],
  );
  const host = useStaticChart(chart);
  return (
    <section class="surface card" aria-label={t("studies.distribution")}>
      <h3>{t("studies.distribution")}</h3>
      <ColumnChoice part="metric" label={t("studies.metric")} isMetric />
      <div
        class="studies-canvas"
        ref={host}
        role="img"
        aria-label={`${t("studies.distribution")}: ${column ? nameColumn(column) : metric}`}
      />
      <p class="row small">
        {laws.map((law, place) => (
          <LawName key={law} law={law} place={place} />
        ))}
      </p>
      <p class="hint">
        {brush.value !== null ? t("studies.ofBrushed") : t("studies.ofShown")};{" "}
        {t("studies.distributionHint")}
      </p>
    </section>
  );
}
