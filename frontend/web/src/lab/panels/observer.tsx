import { putObserver } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { LiveFields } from "../../core/forms/fields";
import { LiveNumber } from "../../core/forms/live";
import { FIELDS } from "../../core/quantities";
import { changeAt, type Schema } from "../../core/schema";
import { currentValueOr } from "../../core/state/conflicts";
import { lawOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { Group } from "./group";

/** Also of a comparison lane. */
export const BANDWIDTH: Schema = {
  ...FIELDS.bandwidth_rad_per_s,
  slider: { min: 2, max: 300, logarithmic: true },
};
const EACH: Schema = {
  properties: {
    bandwidth_rad_per_s: {
      prefixItems: t("channels", { returnObjects: true }).map((title) => ({ ...BANDWIDTH, title })),
    },
  },
};

export function Observer({ state }: { state: SessionState }) {
  const { law, observer } = state.configuration;
  const present = lawOf(law);
  const bandwidth = observer.bandwidth_rad_per_s;
  const isSpread = bandwidth.some((beta) => beta !== bandwidth[0]);
  return (
    <Group title={t("observer.title")} topic="disturbance">
      {present && present.estimate !== "observer" && (
        <p class="hint">{t("observer.unused", { law: present.title })}</p>
      )}
      <LiveNumber
        name="observer.all"
        schema={BANDWIDTH}
        value={bandwidth[0]}
        send={(beta) => putObserver(beta, beta, beta)}
      />
      {isSpread && <p class="hint">{t("observer.spread")}</p>}
      <details class="more">
        <summary>{t("observer.each")}</summary>
        <LiveFields
          name="observer"
          schema={EACH}
          value={observer}
          send={(path, beta) => {
            const next = changeAt(currentValueOr("observer", observer), path, beta);
            return putObserver(...next.bandwidth_rad_per_s);
          }}
        />
      </details>
    </Group>
  );
}
