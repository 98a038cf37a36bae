import { inkOf } from "../../core/plots/inks";
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
        .map(({ ink: number, path }, index) => {
          const ink = inkOf(number);
          return (
            <path
              key={index}
              class={`ink-${ink.colour}`}
              d={path}
              stroke-dasharray={ink.dash.join(" ") || undefined}
            />
          );
        })
        .reverse()}
    </svg>
  );
}
