import { Swatch } from "../../core/plots/legend";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { Table } from "../../core/widgets/tables";
import { nameCurve, type OverlayCurve, TITLES } from "./overlaycurves";
import { type CurveAssessment, listAssessments, type RunAssessment } from "./verdict";

const words = text.verdict;

/** Length of a run that was compared, and whether it is longer. */
function describeCompared(
  { run, verdict }: RunAssessment,
  curves: readonly OverlayCurve[],
): string {
  const { ticks, own_ticks: own, other_ticks: other, compared_s: seconds } = verdict;
  const name = curves.find((curve) => curve.run === run)?.runName ?? run;
  const message = words.compared(name, formatNumber(seconds, 4, 3));
  return ticks === own && ticks === other ? `${message}.` : `${message}; ${words.notAll}.`;
}

function Row({ assessment }: { assessment: CurveAssessment }) {
  const { title, unit } = TITLES[assessment.channel];
  const number = (value: number | null) => formatNumber(value, 4, 6);
  return (
    <tr>
      <th scope="row">
        <span class="line joined metrics-name">
          <Swatch look={assessment.curve.lineStyle} />
          {nameCurve(assessment.curve)}
        </span>
      </th>
      <td>
        {title} <span class="unit">{unit}</span>
      </td>
      <td class={assessment.isWithin ? "good" : "bad strong"}>
        <span aria-hidden="true">{assessment.isWithin ? "✓" : "✗"}</span>{" "}
        {assessment.isWithin ? words.held : words.left}
      </td>
      <td>{formatNumber(assessment.worstS, 4, 3)} s</td>
      <td>{number(assessment.value)}</td>
      <td>{words.range(number(assessment.low), number(assessment.high))}</td>
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
  const message = failed === 0 ? words.allHeld(rows.length) : words.notHeld(failed, rows.length);
  return (
    <>
      <p class="small" role="status">
        <strong class={failed === 0 ? "good" : "bad"}>{message}</strong>{" "}
        {judged.map((runAssessment) => describeCompared(runAssessment, curves)).join(" ")}{" "}
        {words.marks}
      </p>
      <Table
        label={words.table}
        class="overlay-table"
        look="metrics"
        heads={[
          words.curve,
          words.channel,
          words.isHeld,
          words.worst,
          words.value,
          words.band,
          words.outside,
        ]}
      >
        {rows.map((assessment) => (
          <Row key={`${assessment.curve.key}.${assessment.channel}`} assessment={assessment} />
        ))}
      </Table>
    </>
  );
}
