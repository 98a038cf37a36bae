import type { LawTrace } from "../../core/api/falsifications";
import type { Law } from "../../core/api/types";
import type { LineStyle } from "../../core/plots/definitions";
import { dotOf } from "../../core/plots/linestyles";
import { writeFault } from "../../core/state/faults";
import { titleOf, usableLaws } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { DEGREES_PER_RADIAN, formatNumber } from "../../core/units";
import { LawBoxes } from "../../core/widgets/pagelayout";
import { Table } from "../../core/widgets/tables";
import { baselinesOf, findingOf, isBusy, laws, openInLab, scenario, setLaws } from "./falsifier";
import type { DrawnLaw } from "./picture";

const metricOf = (trace: LawTrace, name: string, factor = 1): string => {
  const value = trace.metrics[name];
  return formatNumber(value === null || value === undefined ? null : value * factor, 3);
};

const endOf = ({ fault, fault_s: timeS }: LawTrace): string =>
  fault === null
    ? t("falsifier.whole")
    : t("falsifier.fault", { fault: writeFault(fault), timeS: formatNumber(timeS, 4, 3) });

/** Text for a missing recovery: the run ended, or it did not recover. */
const recoveryOf = (trace: LawTrace): string =>
  trace.fault === null && trace.metrics.recovery_time_s === null
    ? t("falsifier.never")
    : metricOf(trace, "recovery_time_s");

const peakOf = (trace: LawTrace): number => trace.metrics.peak_position_error_rad ?? Infinity;

/** Order: completed runs by error, then ended ones, the last to end first. */
export const rankLaws = (traces: readonly LawTrace[]): LawTrace[] =>
  [...traces].sort((a, b) => {
    if (a.fault === null || b.fault === null) {
      return a.fault === b.fault ? peakOf(a) - peakOf(b) : a.fault === null ? -1 : 1;
    }
    return (b.fault_s ?? 0) - (a.fault_s ?? 0);
  });

interface RowProps {
  trace: LawTrace;
  /** undefined: it is not drawn. */
  lineStyle: LineStyle | undefined;
  onDraw: (law: Law) => void;
}

function Row({ trace, lineStyle, onDraw }: RowProps) {
  const title = titleOf(trace.law);
  return (
    <tr>
      <th scope="row">
        <button
          type="button"
          class="nowrap"
          aria-pressed={lineStyle !== undefined}
          title={t("falsifier.draw", { law: title })}
          onClick={() => onDraw(trace.law)}
        >
          <i class="dot" aria-hidden="true" style={dotOf(lineStyle)} />
          {title}
        </button>
      </th>
      <td class={`nowrap ${trace.fault === null ? "" : "bad strong"}`}>{endOf(trace)}</td>
      <td>{metricOf(trace, "peak_position_error_rad", DEGREES_PER_RADIAN)}</td>
      <td>{metricOf(trace, "steady_state_position_error_rad", DEGREES_PER_RADIAN)}</td>
      <td>{recoveryOf(trace)}</td>
      <td>{metricOf(trace, "peak_stiffness_error_nm_per_rad")}</td>
      <td>
        <button
          type="button"
          class="button"
          title={t("falsifier.seeHint")}
          aria-label={t("falsifier.seeLabel", { law: title })}
          disabled={isBusy.value !== ""}
          onClick={() => void openInLab(trace.law)}
        >
          {t("falsifier.see")}
        </button>
      </td>
    </tr>
  );
}

/** Selection of the laws to run. */
function Choice() {
  const tested = scenario.value && findingOf(scenario.value)?.law;
  return (
    <details>
      <summary>{t("falsifier.choice")}</summary>
      <LawBoxes laws={laws.value} onChange={setLaws} />
      <div class="row">
        <button
          type="button"
          class="button"
          onClick={() => setLaws(usableLaws.value.map(({ name }) => name))}
        >
          {t("falsifier.all")}
        </button>
        {tested && (
          <button type="button" class="button" onClick={() => setLaws(baselinesOf(tested))}>
            {t("falsifier.few")}
          </button>
        )}
      </div>
    </details>
  );
}

interface LawsProps {
  traces: readonly LawTrace[];
  drawn: readonly DrawnLaw[];
  isRunning: boolean;
  onDraw: (law: Law) => void;
}

const COLUMNS = ["law", "end", "peak", "settled", "recovery", "stiffness", "see"] as const;

function describeHeld(held: number, laws: number): string {
  if (held < laws) return t("falsifier.held", { held, laws });
  return laws === 1 ? t("falsifier.noFault") : t("falsifier.noFaults", { laws });
}

/** The laws that completed the run, and those that ended in a fault. */
export function Laws({ traces, drawn, isRunning, onDraw }: LawsProps) {
  const held = traces.filter(({ fault }) => fault === null).length;
  return (
    <section class="surface card wide" aria-label={t("falsifier.laws")}>
      <h3>{t("falsifier.laws")}</h3>
      <p role="status">{isRunning ? t("falsifier.running") : describeHeld(held, traces.length)}</p>
      <Choice />
      <Table heads={COLUMNS.map((key) => t(`falsifier.columns.${key}`))}>
        {rankLaws(traces).map((trace) => (
          <Row
            key={trace.law}
            trace={trace}
            lineStyle={drawn.find(({ law }) => law === trace.law)?.lineStyle}
            onDraw={onDraw}
          />
        ))}
      </Table>
      <p class="hint">{t("falsifier.lawsHint")}</p>
    </section>
  );
}
