import { formatShare } from "../../core/quantities";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { planes, shownMarks, succeeded } from "./drawnrows";
import { countCells, cutBins } from "./points";
import { valuesOf } from "./rows";
import { axes, brush, setBrush } from "./selection";
import { shareOf } from "./shares";
import { rows } from "./studies";

const WIDTH = 320;
const HEIGHT = 240;

/** Color from vermilion (0 %) to blue (100 %). */
const shadeOf = (share: number): string =>
  `color-mix(in oklab, var(--plot-blue) ${Math.round(100 * share)}%, var(--plot-vermilion))`;

const formatSpan = (label: string, edges: readonly number[]): string =>
  `${label}: ${formatNumber(edges[0], 3)} – ${formatNumber(edges.at(-1), 3)}`;

/** Success rate of the brushed runs over the first plane. */
export function SuccessMap() {
  const { x, y, across, up } = planes.s.value;
  const flat = (part: "sx" | "sy", shown: Float64Array, labels: readonly string[] | null) =>
    labels === null ? shown : valuesOf(rows.value, axes.value[part] ?? "");
  const [at, height] = [flat("sx", x, across.labels), flat("sy", y, up.labels)];
  const edges = [cutBins(at, across.isLog), cutBins(height, up.isLog)] as const;
  const cells = countCells(at, height, succeeded.value, shownMarks.value, edges);
  const [columns, lines] = [edges[0].length - 1, edges[1].length - 1];
  return (
    <section class="surface card" aria-label={t("studies.map")}>
      <h3>{t("studies.map")}</h3>
      <svg
        class="drawing sunken studies-map"
        viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
        height="230"
        preserveAspectRatio="none"
        role="img"
        aria-label={`${t("studies.map")}: ${up.label} / ${across.label}`}
      >
        {cells.map(({ column, line, runs, good: held }) => {
          const share = shareOf(held, runs);
          return (
            // biome-ignore lint/a11y/noStaticElementInteractions: the brush has its own number fields
            <rect
              key={`${column} ${line}`}
              x={(WIDTH * column) / columns}
              y={HEIGHT - (HEIGHT * (line + 1)) / lines}
              width={WIDTH / columns}
              height={HEIGHT / lines}
              style={{ fill: shadeOf(held / runs) }}
              onClick={() =>
                setBrush({
                  plane: "s",
                  x: [edges[0][column] as number, edges[0][column + 1] as number],
                  y: [edges[1][line] as number, edges[1][line + 1] as number],
                })
              }
            >
              <title>{`${held}/${runs}${share === null ? "" : `: ${formatShare(share)}`}`}</title>
            </rect>
          );
        })}
      </svg>
      <p class="spread hint">
        <span>↑ {formatSpan(up.label, edges[1])}</span>
        <span>→ {formatSpan(across.label, edges[0])}</span>
      </p>
      <p class="row hint studies-scale" aria-hidden="true">
        {t("studies.mapScale", { share: 0 })} <i /> {t("studies.mapScale", { share: 100 })}
      </p>
      <p class="hint">
        {brush.value !== null ? t("studies.ofBrushed") : t("studies.ofShown")},{" "}
        {t("studies.mapHint")}
      </p>
    </section>
  );
}
