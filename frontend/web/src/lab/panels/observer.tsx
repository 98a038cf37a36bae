import { putObserver } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { quantityProps } from "../../core/quantities";
import { currentValueOr } from "../../core/state/conflicts";
import { lawOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import type { SliderRange } from "../../core/widgets/scale";
import { Field } from "./field";
import { Group } from "./group";

const RANGE: SliderRange = { min: 2, max: 300, logarithmic: true };

export function Observer({ state }: { state: SessionState }) {
  const { law, observer } = state.configuration;
  const present = lawOf(law);
  const bandwidth = observer.bandwidth_rad_per_s;
  const sendOne = (changed: number, beta: number) => {
    const next: typeof bandwidth = [...currentValueOr("observer", observer).bandwidth_rad_per_s];
    next[changed] = beta;
    return putObserver(...next);
  };
  const isSpread = bandwidth.some((beta) => beta !== bandwidth[0]);
  return (
    <Group title={t("observer.title")} topic="disturbance">
      {present && present.estimate !== "observer" && (
        <p class="hint">{t("observer.unused", { law: present.title })}</p>
      )}
      <Field
        name="observer.all"
        {...quantityProps("bandwidth_rad_per_s")}
        value={bandwidth[0]}
        range={RANGE}
        send={(beta) => putObserver(beta, beta, beta)}
      />
      {isSpread && <p class="hint">{t("observer.spread")}</p>}
      <details class="more">
        <summary>{t("observer.each")}</summary>
        {bandwidth.map((beta, index) => (
          <Field
            key={t("channels", { returnObjects: true })[index]}
            name={`observer.${index}`}
            {...quantityProps("bandwidth_rad_per_s")}
            label={t("channels", { returnObjects: true })[index] as string}
            value={beta}
            range={RANGE}
            send={(next) => sendOne(index, next)}
          />
        ))}
      </details>
    </Group>
  );
}
