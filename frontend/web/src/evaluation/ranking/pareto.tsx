import type { Row } from "../../core/api/ranking";
import { t } from "../../core/text/t";
import { formatNumber, toDegrees } from "../../core/units";
import { quantileOf } from "./columns";
import { chosen, results, titleOfRow } from "./ranking";

const [WIDTH, HEIGHT, MARGIN] = [520, 360, 46];
const LARGEST = 14;

interface Point {
  row: Row;
  /** Medians: position error in degrees, stiffness error in N·m/rad, rms u1 in N·m. */
  position: number;
  stiffness: number;
  torque: number;
}

/** The medians of family A of a row; null if one is a trial that ended in a fault. */
export function readPoint(row: Row): Point | null {
  const family = row.families.A;
  if (family === undefined) return null;
  const position = quantileOf(family, "rms_position_error_rad", "middle");
  const stiffness = quantileOf(family, "rms_stiffness_error_nm_per_rad", "middle");
  const torque = quantileOf(family, "rms_torque1_nm", "middle");
  if (position === null || stiffness === null || torque === null) return null;
  return { row, position: toDegrees(position), stiffness, torque };
}

/** Positions of values on a logarithmic axis, from 0 to 1, and the powers of ten between. */
export function scaleLog(values: readonly number[]) {
  const low = Math.log10(Math.min(...values)) - 0.1;
  const high = Math.log10(Math.max(...values)) + 0.1;
  const place = (value: number) => (Math.log10(value) - low) / (high - low);
  const ticks = [];
  for (let power = Math.ceil(low); power <= high; power++) ticks.push(10 ** power);
  return { place, ticks };
}

/** Position error against stiffness error, with effort as size. */
export function Pareto() {
  const points = (results.value?.rows ?? []).flatMap((row) => readPoint(row) ?? []);
  if (points.length === 0) return null;
  const x = scaleLog(points.map(({ position }) => position));
  const y = scaleLog(points.map(({ stiffness }) => stiffness));
  const most = Math.max(...points.map(({ torque }) => torque));
  const left = (value: number) => MARGIN + x.place(value) * (WIDTH - MARGIN - 90);
  const top = (value: number) => HEIGHT - MARGIN - y.place(value) * (HEIGHT - MARGIN - 10);
  return (
    <section class="surface card" aria-labelledby="ranking-pareto">
      <h3 id="ranking-pareto">{t("ranking.pareto")}</h3>
      <p class="hint">{t("ranking.paretoHint")}</p>
      <svg
        class="drawing"
        viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
        role="img"
        aria-label={t("ranking.pareto")}
      >
        {x.ticks.map((tick) => (
          <g key={tick}>
            <line class="grid" x1={left(tick)} x2={left(tick)} y1={10} y2={HEIGHT - MARGIN} />
            <text x={left(tick)} y={HEIGHT - MARGIN + 14} text-anchor="middle">
              {tick}
            </text>
          </g>
        ))}
        {y.ticks.map((tick) => (
          <g key={tick}>
            <line class="grid" x1={MARGIN} x2={WIDTH - 90} y1={top(tick)} y2={top(tick)} />
            <text x={MARGIN - 4} y={top(tick) + 4} text-anchor="end">
              {tick}
            </text>
          </g>
        ))}
        <text x={WIDTH / 2 - 20} y={HEIGHT - 8} text-anchor="middle">
          {t("ranking.positionAxis")}
        </text>
        <text transform={`translate(12 ${HEIGHT / 2}) rotate(-90)`} text-anchor="middle">
          {t("ranking.stiffnessAxis")}
        </text>
        {points.map(({ row, position, stiffness, torque }) => (
          <g key={row.key} class={chosen.value === row.key ? "strong" : ""}>
            <circle
              cx={left(position)}
              cy={top(stiffness)}
              fill={`var(--plot-${chosen.value === row.key ? "orange" : "blue"})`}
              fill-opacity="0.55"
              r={Math.max(3, LARGEST * Math.sqrt(torque / most))}
            >
              <title>
                {t("ranking.point", {
                  law: titleOfRow(row),
                  position: formatNumber(position),
                  stiffness: formatNumber(stiffness),
                  torque: formatNumber(torque),
                })}
              </title>
            </circle>
            <text x={left(position) + 8} y={top(stiffness) - 6}>
              {titleOfRow(row)}
            </text>
          </g>
        ))}
      </svg>
    </section>
  );
}
