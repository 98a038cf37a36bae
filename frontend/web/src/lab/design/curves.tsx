/** A small chart: a few curves on two axes, each linear or logarithmic. */
import { useMemo } from "preact/hooks";
import uPlot from "uplot";
import { niceRange, otherAxis } from "../../core/plots/axes";
import type { Palette } from "../../core/plots/linestyles";
import { drawnCurve, type StaticChart, useStaticChart } from "../../core/plots/staticchart";

export interface Axis {
  label: string;
  /** Limits; if left out, they include the curves and zero. */
  limits?: readonly [number, number];
  isLog?: boolean;
}

export interface Curve {
  look: "tried" | "present" | "each";
  points: readonly (readonly [number, number])[];
  /** Not a valid prediction: drawn fainter. */
  isDoubtful?: boolean;
}

export const LOOKS = {
  tried: { colour: "blue", width: 2, dash: [], alpha: 1 },
  present: { colour: "mark", width: 1.5, dash: [5, 3], alpha: 1 },
  each: { colour: "mark", width: 1, dash: [], alpha: 0.65 },
} as const satisfies Record<Curve["look"], { colour: keyof Palette } & uPlot.Series>;
const DOUBTFUL = 0.45;
const LEAST_SPAN = 1e-3;

const rangeOf =
  ({ limits }: Axis): uPlot.Range.Function =>
  (_, low, high) =>
    limits ? [...limits] : niceRange(Math.min(0, low ?? 0), Math.max(0, high ?? 0), LEAST_SPAN);

function describeCurves(x: Axis, y: Axis, curves: readonly Curve[]): StaticChart {
  const tables = curves.map(
    ({ points }): uPlot.AlignedData => [points.map(([at]) => at), points.map(([, value]) => value)],
  );
  return {
    look: {
      padding: [6, 10, 0, 0],
      scales: {
        x: { time: false, distr: x.isLog ? 3 : 1, range: rangeOf(x) },
        y: { distr: y.isLog ? 3 : 1, range: rangeOf(y) },
      },
      axes: [otherAxis("x", x), otherAxis("y", y)],
      series: [
        {},
        ...curves.map(({ look, isDoubtful }) => ({
          ...drawnCurve(LOOKS[look]),
          alpha: isDoubtful ? DOUBTFUL : LOOKS[look].alpha,
        })),
      ],
    },
    data: tables.length > 0 ? uPlot.join(tables) : [[]],
  };
}

interface CurvesProps {
  title: string;
  /** Description of the curves for screen readers. */
  summary: string;
  x: Axis;
  y: Axis;
  curves: readonly Curve[];
  /** Shown instead of curves without a meaning. */
  note?: string | null;
  /** Why the curves are not a valid prediction: shown above a hatched background. */
  caveat?: string | null;
}

export function Curves({ title, summary, x, y, curves, note, caveat }: CurvesProps) {
  const content = JSON.stringify([x, y, curves]);
  const host = useStaticChart(useMemo(() => describeCurves(x, y, curves), [content]));
  return (
    <figure class={`curves ${caveat ? "is-hatched" : ""}`}>
      <figcaption class="small strong">
        {title} {caveat && <span class="bad">{caveat}</span>}
      </figcaption>
      <div class="chart" ref={host} role="img" aria-label={summary} />
      {note && <p class="over bad small strong">{note}</p>}
    </figure>
  );
}
