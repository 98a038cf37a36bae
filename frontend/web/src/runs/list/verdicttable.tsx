import { Swatch } from "../../core/plots/legend";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { Table } from "../../core/widgets/tables";
import { nameCurve, type OverlayCurve, TITLES } from "./overlaycurves";
import { type CurveAssessment, listAssessments, type RunAssessment } from "./verdict";

/** Length of a run that was compared, and whether it is longer. */
function describeCompared(
  { run, verdict }: RunAssessment,
  curves: readonly OverlayCurve[],
): string {
  const { ticks, own_ticks: own, other_ticks: other, compared_s: seconds } = verdict;
  const name = curves.find((curve) => curve.run === run)?.runName ?? run;
  const message = t("verdict.compared", { run: name, seconds: formatNumber(seconds, 4, 3) });
  return ticks === own && ticks === other ? `${message}.` : `${message}; ${t("verdict.notAll")}.`;
}

function Row({ assessment }: { assessment: CurveAssessment }) {
  const { title, unit } = TITLES[assessment.channel];
  const number = (value: number | null) => formatNumber(value, 4, 6);
  return (
    <tr>
      <th scope="row">
        <span class="line joined">
          <Swatch look={assessment.curve.lineStyle} />
          {nameCurve(assessment.curve)}
        </span>
      </th>
      <td>
        {title} <span class="unit">{unit}</span>
      </td>
      <td class={assessment.isWithin ? "good" : "bad strong"}>
        <span aria-hidden="true">{assessment.isWithin ? "✓" : "✗"}</span>{" "}
        {assessment.isWithin ? t("verdict.held") : t("verdict.left")}
      </td>
      <td>{formatNumber(assessment.worstS, 4, 3)} s</td>
      <td>{number(assessment.value)}</td>
      <td>{t("verdict.range", { low: number(assessment.low), high: number(assessment.high) })}</td>
      <td>{assessment.isWithin ? "–" : `${formatNumber(assessment.outsideS, 4, 3)} s`}</td>
    </tr>
  );
}

interface VerdictTableProps {
  curves: readonly OverlayCurve[];
  judged: readonly RunAssessment[];
}

/** Every channel of every compared curve: passed or not, and its largest deviation. */
export function VerdictTable({ curves, judged }: VerdictTableProps) {
  const rows = listAssessments(curves, judged);
  const failed = rows.filter(({ isWithin: isHeld }) => !isHeld).length;
  const message =
    failed === 0
      ? rows.length === 1
        ? t("verdict.isWithin")
        : t("verdict.allHeld", { runs: rows.length })
      : t("verdict.notHeld", { failed, count: rows.length });
  return (
    <>
      <p class="small" role="status">
        <strong class={failed === 0 ? "good" : "bad"}>{message}</strong>{" "}
        {judged.map((runAssessment) => describeCompared(runAssessment, curves)).join(" ")}{" "}
        {t("verdict.marks")}
      </p>
      <Table
        label={t("verdict.table")}
        class="overlay-table"
        look="metrics"
        heads={[
          t("verdict.curve"),
          t("verdict.channel"),
          t("verdict.isHeld"),
          t("verdict.worst"),
          t("verdict.value"),
          t("verdict.band"),
          t("verdict.outside"),
        ]}
      >
        {rows.map((assessment) => (
          <Row key={`${assessment.curve.key}.${assessment.channel}`} assessment={assessment} />
        ))}
      </Table>
    </>
  );
}
