import { useMemo } from "preact/hooks";
import type uPlot from "uplot";
import type { LawTrace, Scenario, Trace } from "../../core/api/falsifications";
import type { LineStyle } from "../../core/plots/definitions";
import { Swatch } from "../../core/plots/legend";
import { DASHED, DOTTED, PLAIN, palette } from "../../core/plots/linestyles";
import {
  describeTimeChart,
  type StaticCurve,
  spanWithin,
  useStaticChart,
} from "../../core/plots/staticchart";
import { t } from "../../core/text/t";
import { DEGREES_PER_RADIAN } from "../../core/units";
import { BODIES, spanOf } from "./definition";

const TIME_AXIS_PX = 26;
const CROSS_PX = 5;
const TORQUE_LINE_STYLES: readonly LineStyle[] = (
  [
    ["reference", PLAIN],
    ["orange", DASHED],
    ["purple", DOTTED],
  ] as const
).map(([colour, dash]) => ({ colour, dash, width: 2 }));
const MIN_SPANS = { torque: 0.1, position: 0.01, stiffness: 0.01 } as const;
/** A law whose errors are in the picture. */
export interface DrawnLaw extends LawTrace {
  lineStyle: LineStyle;
}

type Chart = keyof typeof MIN_SPANS;

function curvesOf(chart: Chart, trace: Trace, drawn: readonly DrawnLaw[]): StaticCurve[] {
  if (chart === "torque") {
    return BODIES.map((body, at) => ({
      key: body,
      ...(TORQUE_LINE_STYLES[at] as LineStyle),
      values: trace.torque_nm.map((torques) => torques[at] as number),
    })).filter(({ values }, at) => at === 0 || values.some((value) => value !== 0));
  }
  return drawn.map((lawTrace) => ({
    key: lawTrace.law,
    ...lawTrace.lineStyle,
    values:
      chart === "position"
        ? lawTrace.position_error_rad.map((value) => value && value * DEGREES_PER_RADIAN)
        : lawTrace.stiffness_error_nm_per_rad,
  }));
}

/** A cross at the fault of a run. */
function drawCrosses(plot: uPlot, trace: Trace, drawn: readonly DrawnLaw[]): void {
  const { ctx: context } = plot;
  const reach = CROSS_PX * devicePixelRatio;
  drawn.forEach((lawTrace, at) => {
    const values = plot.data[at + 1] ?? [];
    const last = lawTrace.position_error_rad.filter((value) => value !== null).length - 1;
    if (lawTrace.fault === null || last < 0) return;
    const x = plot.valToPos(trace.time_s[last] as number, "x", true);
    const y = plot.valToPos(values[last] as number, "y", true);
    context.save();
    context.strokeStyle = palette.peek()[lawTrace.lineStyle.colour];
    context.lineWidth = 2.5 * devicePixelRatio;
    context.setLineDash([]);
    context.beginPath();
    for (const slope of [1, -1]) {
      context.moveTo(x - reach, y - slope * reach);
      context.lineTo(x + reach, y + slope * reach);
    }
    context.stroke();
    context.restore();
  });
}

interface ChartProps {
  chart: Chart;
  trace: Trace;
  drawn: readonly DrawnLaw[];
  view: ReturnType<typeof spanWithin>;
}

function describeChart(curves: readonly StaticCurve[], { chart, trace, drawn, view }: ChartProps) {
  const hasTimes = chart === "stiffness";
  return describeTimeChart({
    time: trace.time_s,
    curves,
    minSpan: MIN_SPANS[chart],
    padding: [8, 14, hasTimes ? 0 : 8, 0],
    timeAxis: {
      size: hasTimes ? TIME_AXIS_PX : 0,
      tick: (timeS: number) => t("falsifier.secondTick", { timeS: Number(timeS.toFixed(3)) }),
    },
    group: "falsifier",
    ...view,
    ...(chart !== "torque" && { drawAbove: (plot: uPlot) => drawCrosses(plot, trace, drawn) }),
  });
}

function ErrorChart(props: ChartProps) {
  const { chart, trace, drawn, view } = props;
  const curves = useMemo(() => curvesOf(chart, trace, drawn), [chart, trace, drawn]);
  const host = useStaticChart(useMemo(() => describeChart(curves, props), [curves, view]));
  const [title, unit] = [t(`falsifier.charts.${chart}.title`), t(`falsifier.charts.${chart}.unit`)];
  const bodies = curves.filter(({ key }) => BODIES.some((body) => body === key));
  return (
    <section aria-label={title}>
      <h4>
        {title} <span class="unit">{unit}</span>
        {bodies.length > 1 &&
          bodies.map((body) => (
            <span key={body.key} class="unit">
              <Swatch look={body} /> {t(`falsifier.bodies.${body.key as (typeof BODIES)[number]}`)}
            </span>
          ))}
      </h4>
      <div
        class="chart"
        ref={host}
        role="img"
        aria-label={`${title}, ${unit}`}
        title={t("falsifier.pictureHint")}
      />
    </section>
  );
}

interface PictureProps {
  scenario: Scenario;
  trace: Trace;
  drawn: readonly DrawnLaw[];
}

/** The torques of the loads, and below them the errors that they cause. */
export function TracePlots({ scenario, trace, drawn }: PictureProps) {
  const view = useMemo(() => spanWithin(spanOf(scenario, trace.time_s)), [trace]);
  return (
    <section class="surface card wide" aria-label={t("falsifier.picture")}>
      <h3>{t("falsifier.picture")}</h3>
      {(["torque", "position", "stiffness"] as const).map((chart) => (
        <ErrorChart key={chart} {...{ chart, trace, drawn, view }} />
      ))}
      <p class="hint">
        {drawn.some(({ fault }) => fault !== null) && <>{t("falsifier.crosses")}. </>}
        {t("falsifier.pictureHint")}
      </p>
    </section>
  );
}
