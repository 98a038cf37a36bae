import type { SessionState } from "../core/api/types";
import { isLive } from "../core/state/session";
import { t } from "../core/text/t";
import { formatNumber, toDegrees } from "../core/units";
import { AllMetricsButton } from "./allmetrics";
import { CurrentError } from "./currenterror";
import { type Recovery, recoveryNameOf, recoveryOf, sinceOf } from "./window";

const degrees = (rad: number | null | undefined) =>
  formatNumber(rad === null || rad === undefined ? null : toDegrees(rad), 3, 4);

function Recovered({ recovery: { seconds, words } }: { recovery: Recovery }) {
  if (seconds === null) return <span class="muted">{words}</span>;
  return (
    <>
      {words} <span class="unit">s</span>
    </>
  );
}

/** The main metrics of the controller. */
export function Readout({ state }: { state: SessionState }) {
  const { window, lanes } = state;
  const metrics = lanes[0]?.in_window;
  const since = <span>{t(`readout.since.${window.kind}`)}</span>;
  const recovery = recoveryOf(metrics ?? null, window);
  return (
    <dl class="surface tabular readout" aria-label={t("readout.heading")}>
      <div class="spread is-main">
        <dt>
          {isLive.value ? t("readout.error") : t("readout.lastError")}{" "}
          <AllMetricsButton state={state} />
        </dt>
        <dd>
          <CurrentError of={lanes[0]} maxDigits={4} /> <span class="unit">deg</span>
        </dd>
      </div>
      <div title={sinceOf(window)}>
        <dt>
          {t("readout.rms")} {since}
        </dt>
        <dd>
          {degrees(metrics?.rms_position_error_rad)} <span class="unit">deg</span>
        </dd>
      </div>
      <div title={sinceOf(window)}>
        <dt>
          {t("readout.peak")} {since}
        </dt>
        <dd>
          {degrees(metrics?.peak_position_error_rad)} <span class="unit">deg</span>
        </dd>
      </div>
      <div title={state.bench === null ? recovery.hint : t("windows.marked.hint")}>
        <dt>{recoveryNameOf(state).name}</dt>
        <dd>
          <Recovered recovery={recovery} />
        </dd>
      </div>
    </dl>
  );
}
