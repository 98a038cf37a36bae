import type { Trial, Tuning } from "../../core/api/jobs";
import { text } from "../../core/text/en";
import { formatInput, formatNumber } from "../../core/units";
import { Table } from "../../core/widgets/tables";

const words = text.tuning;

interface FoundProps {
  tuning: Tuning;
  present: Trial;
  best: Trial;
}

/** Every number that is searched: as it was, the best, and between which ends. */
export function ValueTable({ tuning, present, best }: FoundProps) {
  return (
    <Table
      label={words.values}
      look="metrics"
      heads={[words.parameter, words.before, words.tuned, words.range]}
    >
      {tuning.axes.map((axis, index) => (
        <tr key={axis.name}>
          <th scope="row" title={axis.name}>
            <i>{axis.symbol}</i> <small>{axis.unit === "1" ? "" : axis.unit}</small>
          </th>
          <td>{formatInput(present.values[index] ?? 0, 4)}</td>
          <td class="strong">{formatInput(best.values[index] ?? 0, 4)}</td>
          <td class="muted">{`${formatInput(axis.low, 3)} – ${formatInput(axis.high, 3)}`}</td>
        </tr>
      ))}
    </Table>
  );
}

/** What each training run cost before, and costs with the best. */
export function RunTable({ tuning, present, best }: FoundProps) {
  return (
    <Table
      label={words.runs}
      class="wide"
      look="metrics"
      heads={[
        words.run,
        ...[words.runCost, words.runError, words.runStiffness, words.runTorqueChange].map(
          (head) => (
            <span key={head} title={words.runHint}>
              {head}
            </span>
          ),
        ),
      ]}
    >
      {tuning.runs.map((run, index) => {
        const before = present.runs[index];
        const after = best.runs[index];
        if (before === undefined || after === undefined) return null;
        const formatPair = (old: number, now: number) =>
          words.arrow(formatNumber(old), formatNumber(now));
        return (
          <tr key={run.name}>
            <th scope="row">
              {run.title}
              {after.fault && <span class="bad"> {words.fault}</span>}
            </th>
            <td class="strong">{formatPair(before.cost, after.cost)}</td>
            <td>{formatPair(before.position_error_deg, after.position_error_deg)}</td>
            <td>
              {formatPair(before.stiffness_error_nm_per_rad, after.stiffness_error_nm_per_rad)}
            </td>
            <td>{formatPair(before.torque_change_nm, after.torque_change_nm)}</td>
          </tr>
        );
      })}
      <tr>
        <th scope="row">{words.mean}</th>
        <td class="strong">{words.arrow(formatNumber(present.cost), formatNumber(best.cost))}</td>
        <td colSpan={3} />
      </tr>
    </Table>
  );
}
