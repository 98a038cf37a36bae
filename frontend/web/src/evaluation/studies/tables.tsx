import type { Estimate } from "../../core/api/studies";
import { isJobRunning } from "../../core/jobs/progress";
import { dotOf } from "../../core/plots/linestyles";
import { formatShare } from "../../core/quantities";
import { writeFault } from "../../core/state/faults";
import { titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { Table } from "../../core/widgets/tables";
import { columnOf, endedInFault, lawLineStyles, marksOf, succeeded } from "./drawnrows";
import { shareOf } from "./shares";
import { axes, brush, indices, study, summary } from "./studies";
import { factorOf, nameColumn, shownUnit } from "./studyview";

const words = text.studies;

/** An estimate with its interval times a factor, or a note that there is no interval. */
function formatEstimate({ value, low, high }: Estimate, factor: number, decimals?: number): string {
  const shown = (quantity: number | null) =>
    quantity === null ? null : formatNumber(quantity * factor, decimals ?? 3, decimals);
  return words.estimate(shown(value) ?? "–", shown(low), shown(high));
}

const NONE: Estimate = { value: null, low: null, high: null };
const formatP = (value: number | null | undefined): string =>
  value != null && value < 1e-4 ? words.pSmall : formatNumber(value, 2);

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
      ? words.fault
      : formatNumber((value ?? Number.NaN) * factorOf(metric?.unit ?? ""), 3);
  return (
    <section class="surface card wide" aria-label={words.byLaw}>
      <h3>{words.byLaw}</h3>
      {studySummary === null && (
        <p class="hint" role="status">
          {isJobRunning(study.value?.job ?? null) ? words.later : words.summing}
        </p>
      )}
      <Table
        heads={[
          words.law,
          words.all,
          words.succeeded,
          ...(brush.value ? [words.inBrush] : []),
          words.faults,
          ...(metric ? [words.median(nameColumn(metric))] : []),
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
              <td>{lawRow?.runs.toLocaleString("en") ?? "–"}</td>
              <td>{lawRow ? formatShare(lawRow.success) : "–"}</td>
              {brush.value && <td>{inBrush(place)}</td>}
              <td>
                {lawRow ? faults.join(", ") || words.noFaults : "–"}
                {lawRow && lawRow.refused > 0 && `; ${words.refused(lawRow.refused)}`}
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
            <b>{words.pair(titleOf(pair.one), titleOf(pair.other))}</b>{" "}
            {words.points(formatEstimate(pair.success, 100))};{" "}
            {words.pSuccess(formatP(pair.success_p))}; {words.only(pair.only_one, pair.only_other)}.
            {metric && difference && (
              <>
                {" "}
                {words.difference(nameColumn(metric), pair.whole)}:{" "}
                {formatEstimate(difference, factorOf(metric.unit))} {shownUnit(metric.unit)};{" "}
                {words.pMetric(formatP(pair.p_values[metric.name]))}
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
    <section class="surface card wide" aria-label={words.sensitivity}>
      <h3>{words.sensitivity}</h3>
      <p class="hint">{words.sensitivityHint}</p>
      {indices.value.map(({ law, first_order: own, total_order: total }) => (
        <div key={law} class="studies-bars">
          <h4>{titleOf(law)}</h4>
          <dl>
            {Object.keys(total)
              .sort((a, b) => (total[b]?.value ?? 0) - (total[a]?.value ?? 0))
              .map((name) => (
                <div key={name}>
                  <dt>{columnOf(name)?.label ?? name}</dt>
                  {([own[name], total[name]] as const).map((estimate, at) => (
                    <dd
                      key={at === 0 ? "own" : "total"}
                      title={at === 0 ? words.itself : words.together}
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
