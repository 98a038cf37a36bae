import type { SessionState } from "../core/api/types";
import { AllMetrics } from "../core/plots/allmetrics";
import { lineStyleOfLane } from "../core/plots/linestyles";
import { t } from "../core/text/t";
import { Popup } from "../core/widgets/popup";
import { isDisturbed } from "../runs/list/measured";
import { sinceOf } from "./window";

/** A button that opens every metric of the lanes since the last change. */
export function AllMetricsButton({ state: { lanes, window } }: { state: SessionState }) {
  const disturbed = isDisturbed(window);
  return (
    <Popup
      class="quiet small"
      popupClass="metrics-popup"
      button={t("metrics.all")}
      name={t("metrics.all")}
      title={t("metrics.allHint")}
    >
      {() => (
        <AllMetrics
          caption={sinceOf(window)}
          lanes={lanes.map(({ lane, name, segments, in_window: metrics }) => ({
            key: String(lane),
            look: lineStyleOfLane(segments.at(-1)?.line_style ?? 0, lane === 1),
            name,
            metrics,
            isDisturbed: disturbed,
          }))}
        />
      )}
    </Popup>
  );
}
