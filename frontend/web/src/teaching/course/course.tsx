import { t } from "../../core/text/t";
import { toDegrees } from "../../core/units";
import type { ErrorHistory } from "./outcome";

const WIDTH = 460;
const HEIGHT = 108;
const LEFT = 44;
const BOTTOM = 18;
const TOP = 6;
const RIGHT = 14;
const END_S = 20;
const LOAD_S = 5;
const COLUMNS = 200;
/** Decades of degrees, from the bottom to the top. */
const MIN = -4;
const MAX = 2;

const xOf = (timeS: number) => LEFT + (timeS / END_S) * (WIDTH - LEFT - RIGHT);
const yOf = (degrees: number) => {
  const decade = Math.log10(Math.max(degrees, 10 ** MIN));
  return (HEIGHT - BOTTOM - TOP) * (1 - (decade - MIN) / (MAX - MIN)) + TOP;
};

/** The largest error of each column, so that no peak is lost. */
function envelope(timeS: readonly number[], errors: readonly number[]): string {
  const columns = new Float64Array(COLUMNS);
  timeS.forEach((time, index) => {
    const column = Math.min(COLUMNS - 1, Math.floor((time / END_S) * COLUMNS));
    const size = Math.abs(errors[index] as number);
    if (size > (columns[column] as number)) columns[column] = size;
  });
  return Array.from(columns, (size, column) => {
    const x = xOf(((column + 0.5) / COLUMNS) * END_S);
    return `${x.toFixed(1)},${yOf(toDegrees(size)).toFixed(1)}`;
  }).join(" ");
}

/** The errors of both laws over the whole experiment, small and logarithmic. */
export function ErrorPlot({ course }: { course: ErrorHistory }) {
  const [fl, ndobc] = course.positionRad;
  return (
    <svg
      class="drawing sunken"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      role="img"
      aria-label={t("claims.curve")}
    >
      {[-4, -2, 0, 2].map((decade) => (
        <g key={decade}>
          <path class="grid" d={`M${LEFT} ${yOf(10 ** decade)}H${WIDTH - RIGHT}`} />
          <text x={LEFT - 5} y={yOf(10 ** decade) + 4} text-anchor="end">
            {`${10 ** decade}°`.replace("0.0001", "10⁻⁴")}
          </text>
        </g>
      ))}
      {[0, 5, 10, 15, 20].map((time) => (
        <text key={time} x={xOf(time)} y={HEIGHT - 3} text-anchor="middle">
          {t("plots.seconds", { seconds: time })}
        </text>
      ))}
      <path class="grid" stroke-dasharray="2 3" d={`M${xOf(LOAD_S)} ${TOP}V${HEIGHT - BOTTOM}`} />
      <text class="strong" x={xOf(LOAD_S) + 4} y={TOP + 10}>
        {t("claims.loadMark")}
      </text>
      <g fill="none" stroke-width="1.8">
        <polyline
          stroke="var(--plot-orange)"
          stroke-dasharray="6 3"
          points={envelope(course.timeS, fl)}
        />
        <polyline stroke="var(--plot-blue)" points={envelope(course.timeS, ndobc)} />
      </g>
      <text class="strong" x={WIDTH - RIGHT - 2} y={yOf(12) - 5} text-anchor="end">
        {t("controller.fl")}
      </text>
      <text class="strong" x={WIDTH - RIGHT - 2} y={yOf(0.002) - 6} text-anchor="end">
        {t("controller.ndobc")}
      </text>
    </svg>
  );
}
