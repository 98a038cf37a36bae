import { lineStyleOf } from "../../core/plots/linestyles";
import { text } from "../../core/text/en";
import { formatNumber, toDegrees } from "../../core/units";
import { type Glance, HEIGHT, WIDTH } from "./spark";

/** The position error of every lane over the whole run; nothing until it is read. */
export function Sparkline({ glance }: { glance: Glance | null }) {
  const label = glance
    ? text.runs.sparkline(glance.lanes.join(", "), formatNumber(toDegrees(glance.peak), 2, 3))
    : text.runs.noSparkline;
  return (
    <svg
      class="sparkline"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      preserveAspectRatio="none"
      role="img"
      aria-label={label}
    >
      {glance && <path class="spark-zero" d={`M0 ${glance.zero}H${WIDTH}`} />}
      {glance?.paths
        .map(({ lineStyle: number, path }, index) => {
          const lineStyle = lineStyleOf(number);
          return (
            <path
              key={index}
              class={`ink-${lineStyle.colour}`}
              d={path}
              stroke-dasharray={lineStyle.dash.join(" ") || undefined}
            />
          );
        })
        .reverse()}
    </svg>
  );
}
