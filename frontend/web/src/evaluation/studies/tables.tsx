import type { Estimate } from "../../core/api/studies";
import { isJobRunning } from "../../core/jobs/progress";
import { dotOf } from "../../core/plots/linestyles";
import { formatShare } from "../../core/quantities";
import { writeFault } from "../../core/state/faults";
import { titleOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { formatCount, formatNumber } from "../../core/units";
import { Table } from "../../core/widgets/tables";
import { columnOf, endedInFault, lawLineStyles, marksOf, succeeded } from "./drawnrows";
import { axes, brush, study } from "./selection";
import { shareOf } from "./shares";
import { indices, summary } from "./studies";
import { factorOf, nameColumn, shownUnit } from "./studyview";

/** An estimate with its interval times a factor, or a note that there is no interval. */
function formatEstimate({ value, low, high }: Estimate, factor: number, decimals?: number): string {
  const write = (quantity: number | null) =>
    formatNumber(quantity === null ? null : quantity * factor, decimals ?? 3, decimals);
  return low === null
    ? t("studies.noInterval", { value: write(value) })
    : t("studies.estimate", { value: write(value), low: write(low), high: write(high) });
}

const NONE: Estimate = { value: null, low: null, high: null };
const formatP = (value: number | null | undefined): string =>
  value != null && value < 1e-4 ? t("studies.pSmall") : formatNumber(value, 2);

/** Results of a law in the brush, with intervals once the server has sent them. */
function inBrush(place: number): string {
  const [marks, isGood, isEnded] = [marksOf(place), succeeded.value, endedInFault.value];
  let [runs, held] = [0, 0];
  marks.forEach((mark, index) => {
    if (mark === 0) return;
    runs++;
    if (isGood[index] === 1 && isEnded[index] === 0) held++;
  });
  if (runs === 0) return "–";
  const share = shareOf(held, runs);
  return share === null ? `${held}/${runs}` : `${held}/${runs}: ${formatShare(share)}`;
}

/** A law with the color of its runs. place: index among the laws of the study. */
export const LawName = ({ law, place }: { law: string; place: number }) => (
  <span class="nowrap">
    <i class="dot" style={dotOf(lawLineStyles.value[place])} aria-hidden="true" />
    {titleOf(law)}
  </span>
);

export function LawTable() {
  const studySummary = summary.value;
  const metric = columnOf(axes.value.metric ?? "");
  const formatMetric = (value: number | null | undefined) =>
    value === null
      ? t("studies.fault")
      : formatNumber((value ?? Number.NaN) * factorOf(metric?.unit ?? ""), 3);
  return (
    <section class="surface card wide" aria-label={t("studies.byLaw")}>
      <h3>{t("studies.byLaw")}</h3>
      {studySummary === null && (
        <p class="hint" role="status">
          {isJobRunning(study.value?.job ?? null) ? t("studies.later") : t("studies.summing")}
        </p>
      )}
      <Table
        heads={[
          t("studies.law"),
          t("studies.all"),
          t("studies.succeeded"),
          ...(brush.value ? [t("studies.inBrush")] : []),
          t("studies.faults"),
          ...(metric ? [t("studies.median", { metric: nameColumn(metric) })] : []),
        ]}
      >
        {(study.value?.laws ?? []).map((law, place) => {
          const lawRow = studySummary?.laws.find((row) => row.law === law);
          const faults = Object.entries(lawRow?.faults ?? {}).map(
            ([code, count]) => `${count} ${writeFault(code)}`,
          );
          return (
            <tr key={law}>
              <th scope="row">
                <LawName law={law} place={place} />
              </th>
              <td>{lawRow ? formatCount(lawRow.runs) : "–"}</td>
              <td>{lawRow ? formatShare(lawRow.success) : "–"}</td>
              {brush.value && <td>{inBrush(place)}</td>}
              <td>
                {lawRow ? faults.join(", ") || t("studies.noFaults") : "–"}
                {lawRow &&
                  lawRow.refused > 0 &&
                  `; ${t("studies.refused", { count: lawRow.refused })}`}
              </td>
              {metric && (
                <td>
                  {lawRow ? lawRow.quantiles[metric.name]?.map(formatMetric).join(" / ") : "–"}
                </td>
              )}
            </tr>
          );
        })}
      </Table>
      {(studySummary?.pairings ?? []).map((pair) => {
        const difference = metric && pair.differences[metric.name];
        return (
          <p key={pair.other}>
            <b>{t("studies.pair", { first: titleOf(pair.one), second: titleOf(pair.other) })}</b>{" "}
            {t("studies.points", { estimate: formatEstimate(pair.success, 100) })};{" "}
            {t("studies.pSuccess", { value: formatP(pair.success_p) })};{" "}
            {t("studies.only", {
              samples: t("studies.samples", { count: pair.only_one }),
              second: pair.only_other,
            })}
            .
            {metric && difference && (
              <>
                {" "}
                {t("studies.difference", { metric: nameColumn(metric), count: pair.whole })}:{" "}
                {formatEstimate(difference, factorOf(metric.unit))} {shownUnit(metric.unit)};{" "}
                {t("studies.pMetric", { value: formatP(pair.p_values[metric.name]) })}
              </>
            )}
          </p>
        );
      })}
    </section>
  );
}

/** Bars of Sobol indices in descending order. */
export function Sensitivity() {
  if (indices.value.length === 0) return null;
  return (
    <section class="surface card wide" aria-label={t("studies.sensitivity")}>
      <h3>{t("studies.sensitivity")}</h3>
      <p class="hint">{t("studies.sensitivityHint")}</p>
      {indices.value.map(({ law, first_order: own, total_order: total }) => (
        <div key={law} class="studies-bars">
          <h4>{titleOf(law)}</h4>
          <dl>
            {Object.keys(total)
              .sort((a, b) => (total[b]?.value ?? 0) - (total[a]?.value ?? 0))
              .map((name) => (
                <div key={name} class="cells" style={{ "--cell": "180px" }}>
                  <dt>{columnOf(name)?.label ?? name}</dt>
                  {([own[name], total[name]] as const).map((estimate, at) => (
                    <dd
                      key={at === 0 ? "own" : "total"}
                      title={at === 0 ? t("studies.itself") : t("studies.together")}
                    >
                      <i
                        class={at === 0 ? "is-own" : "is-total"}
                        style={{
                          width: `${100 * Math.min(1, Math.max(0, estimate?.value ?? 0))}%`,
                        }}
                      />
                      <small>{formatEstimate(estimate ?? NONE, 1, 2)}</small>
                    </dd>
                  ))}
                </div>
              ))}
          </dl>
        </div>
      ))}
    </section>
  );
}
