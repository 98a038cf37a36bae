/** A small chart: a few curves on two axes, each even or logarithmic. */
import { useId } from "preact/hooks";
import { text } from "../../core/text/en";

export interface Axis {
  from: number;
  to: number;
  ticks: readonly number[];
  label: string;
  isLogarithmic?: boolean;
}

export interface Curve {
  look: "tried" | "present";
  points: readonly (readonly [number, number])[];
  /** Not what would happen: drawn fainter. */
  isDoubtful?: boolean;
}

const WIDTH = 340;
const HEIGHT = 160;
const LEFT = 44;
const RIGHT = 8;
/** The name of the upright axis stands above it, where no curve comes. */
const TOP = 18;
const BOTTOM = 30;

/** Where a value stands between the ends of an axis, 0 to 1. */
export function shareOf(value: number, { from, to, isLogarithmic }: Axis): number {
  return isLogarithmic
    ? Math.log(value / from) / Math.log(to / from)
    : (value - from) / (to - from);
}

const xOf = (value: number, axis: Axis) => LEFT + shareOf(value, axis) * (WIDTH - LEFT - RIGHT);
const yOf = (value: number, axis: Axis) =>
  HEIGHT - BOTTOM - shareOf(value, axis) * (HEIGHT - TOP - BOTTOM);

export function pathOf(points: Curve["points"], x: Axis, y: Axis): string {
  const places = points.map(
    ([at, value]) => `${xOf(at, x).toFixed(1)} ${yOf(value, y).toFixed(1)}`,
  );
  return places.length === 0 ? "" : `M${places.join("L")}`;
}

interface CurvesProps {
  title: string;
  /** What the curves show, for who does not see them. */
  summary: string;
  x: Axis;
  y: Axis;
  curves: readonly Curve[];
  /** Stands in place of curves that have no meaning. */
  note?: string | null;
  /** Why the curves are not what would happen: written above a hatched ground. */
  caveat?: string | null;
}

export function Curves({ title, summary, x, y, curves, note, caveat }: CurvesProps) {
  const clip = useId();
  const hatch = useId();
  const right = WIDTH - RIGHT;
  const bottom = HEIGHT - BOTTOM;
  return (
    <figure class="curves">
      <figcaption>{title}</figcaption>
      <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="img" aria-label={summary}>
        <clipPath id={clip}>
          <rect x={LEFT} y={TOP} width={right - LEFT} height={bottom - TOP} />
        </clipPath>
        {caveat && (
          <>
            <pattern id={hatch} width="8" height="8" patternUnits="userSpaceOnUse">
              <path d="M-2 10L10-2M-2 2L2-2M6 10L10 6" class="curves-hatch" />
            </pattern>
            <rect
              x={LEFT}
              y={TOP}
              width={right - LEFT}
              height={bottom - TOP}
              fill={`url(#${hatch})`}
            />
          </>
        )}
        {x.ticks.map((tick) => (
          <g key={tick}>
            <path class="curves-grid" d={`M${xOf(tick, x)} ${TOP}V${bottom}`} />
            <text x={xOf(tick, x)} y={bottom + 13} text-anchor="middle">
              {Number(tick.toPrecision(3))}
            </text>
          </g>
        ))}
        {y.ticks.map((tick) => (
          <g key={tick}>
            <path class="curves-grid" d={`M${LEFT} ${yOf(tick, y)}H${right}`} />
            <text x={LEFT - 5} y={yOf(tick, y) + 4} text-anchor="end">
              {String(Number(tick.toPrecision(3))).replace("-", "\u2212")}
            </text>
          </g>
        ))}
        <text class="curves-axis" x={right} y={HEIGHT - 3} text-anchor="end">
          {x.label}
        </text>
        <text class="curves-axis" x={LEFT} y={TOP - 7}>
          {y.label}
        </text>
        <g clip-path={`url(#${clip})`}>
          {curves.map((curve) => (
            <path
              key={curve.look}
              class={`curve is-${curve.look} ${curve.isDoubtful ? "is-doubtful" : ""}`}
              d={pathOf(curve.points, x, y)}
            />
          ))}
        </g>
        {caveat && (
          <text class="curves-note" x={right} y={TOP - 6} text-anchor="end">
            {caveat}
          </text>
        )}
        {note && (
          <text
            class="curves-note"
            x={(LEFT + right) / 2}
            y={(TOP + bottom) / 2}
            text-anchor="middle"
          >
            {note}
          </text>
        )}
      </svg>
    </figure>
  );
}

const HEIGHTS = [2, 3, 4, 5, 6, 8, 10, 15, 20, 40];

/** The error, high enough for both curves, with the side on which they are. */
export function errorAxis(curves: readonly Curve["points"][]): Axis {
  const values = curves.flatMap((points) => points.map(([, value]) => value));
  const least = Math.min(0, ...values);
  const most = Math.max(0, ...values);
  const height = (size: number) =>
    size < 0.05 * Math.max(-least, most)
      ? 0
      : (HEIGHTS.find((one) => one >= 1.05 * size) ?? (HEIGHTS.at(-1) as number));
  const from = -height(-least);
  const to = height(most) || (from === 0 ? 2 : 0.15 * -from);
  const reach = Math.max(-from, to);
  const ticks = [-reach, -reach / 2, 0, reach / 2, reach].filter(
    (tick) => tick >= from && tick <= to,
  );
  return { from, to, ticks, label: text.stability.error };
}
