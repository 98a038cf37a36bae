import { putLane } from "../../core/api/client";
import type { Gains, LawRow, SessionState } from "../../core/api/types";
import { LiveNumber } from "../../core/forms/live";
import { FIELDS } from "../../core/quantities";
import type { SliderRange } from "../../core/scale";
import { perform } from "../../core/state/actions";
import { type ComparisonLane, gainsOf, hasOwnSettings } from "../../core/state/lanes";
import { t } from "../../core/text/t";
import { Problem } from "../../core/widgets/form";
import { coefficientsOf } from "../design/poles";
import { ParameterFields } from "./law";
import { BANDWIDTH } from "./observer";

const POLES: SliderRange = { min: 5, max: 200, logarithmic: true };

interface LaneFormProps {
  law: LawRow;
  state: SessionState;
  comparison: ComparisonLane;
}

/** One bandwidth for all poles of a polynomial, c₀ = ωⁿ. */
function Bandwidths({ state, comparison }: Omit<LaneFormProps, "law">) {
  const { lane, id, controller } = comparison;
  const gains = gainsOf(controller, state);
  const put = (changed: Partial<Gains>) =>
    putLane(lane, { ...controller, gains: { ...gains, ...changed } });
  const row = (group: "position" | "stiffness", symbol: string) => {
    const held = gains[`${group}_coefficients`];
    const bandwidth = held[0] ** (1 / held.length);
    const all = coefficientsOf(held.length, bandwidth);
    const isTogether = all.every((c, k) => Math.abs(c / (held[k] as number) - 1) < 1e-3);
    return (
      <>
        <LiveNumber
          name={`lanes.${id}.${group}`}
          schema={{
            ...FIELDS.bandwidth_rad_per_s,
            symbol,
            title: t("comparisons.poles", { group: t(`design.${group}`) }),
            slider: POLES,
          }}
          value={bandwidth}
          send={(value) => put({ [`${group}_coefficients`]: coefficientsOf(held.length, value) })}
        />
        {!isTogether && <p class="hint">{t("comparisons.apart", { symbol })}</p>}
      </>
    );
  };
  return (
    <>
      {row("position", "ωq")}
      {row("stiffness", "ωσ")}
    </>
  );
}

/** Settings of a comparison lane; the first change gives it its own settings. */
export function LaneForm({ law, state, comparison }: LaneFormProps) {
  const { lane, id, controller } = comparison;
  const { configuration } = state;
  const observer = controller.observer ?? configuration.observer;
  const held = controller.parameters ?? configuration.parameters[law.name] ?? {};
  const isOwn = hasOwnSettings(controller);
  return (
    <div class="stack tight lane-form">
      <p class="hint">
        {isOwn ? t("comparisons.ownHint") : t("comparisons.sharedHint")}
        {isOwn && (
          <button
            type="button"
            class="quiet"
            onClick={() => void perform(`lanes.${id}`, putLane(lane, { law: controller.law }))}
          >
            {t("comparisons.share")}
          </button>
        )}
      </p>
      <Problem control={`lanes.${id}`} />
      {law.takes_gains && <Bandwidths state={state} comparison={comparison} />}
      <ParameterFields
        law={law}
        name={`lanes.${id}`}
        held={held}
        send={(parameters) => putLane(lane, { ...controller, parameters })}
      />
      {law.estimate === "observer" && (
        <LiveNumber
          name={`lanes.${id}.observer`}
          schema={{ ...BANDWIDTH, symbol: "β", title: t("design.observerBandwidth") }}
          value={observer.bandwidth_rad_per_s[0]}
          send={(beta) =>
            putLane(lane, { ...controller, observer: { bandwidth_rad_per_s: [beta, beta, beta] } })
          }
        />
      )}
    </div>
  );
}
