import type { Trial, Tuning } from "../../core/api/jobs";
import { text } from "../../core/text/en";
import { formatInput, formatNumber } from "../../core/units";

const words = text.tuning;

interface FoundProps {
  tuning: Tuning;
  present: Trial;
  best: Trial;
}

/** Every number that is searched: as it was, the best, and between which ends. */
export function ValueTable({ tuning, present, best }: FoundProps) {
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by keyboard
    <section class="tuning-scroll" tabIndex={0} aria-label={words.values}>
      <table>
        <thead>
          <tr>
            <th scope="col">{words.parameter}</th>
            <th scope="col">{words.before}</th>
            <th scope="col">{words.tuned}</th>
            <th scope="col">{words.range}</th>
          </tr>
        </thead>
        <tbody>
          {tuning.axes.map((axis, index) => (
            <tr key={axis.name}>
              <th scope="row" title={axis.name}>
                <i>{axis.symbol}</i> <small>{axis.unit === "1" ? "" : axis.unit}</small>
              </th>
              <td>{formatInput(present.values[index] ?? 0, 4)}</td>
              <td class="is-best">{formatInput(best.values[index] ?? 0, 4)}</td>
              <td class="is-range">
                {`${formatInput(axis.low, 3)} – ${formatInput(axis.high, 3)}`}
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

/** What each training run cost before, and costs with the best. */
export function RunTable({ tuning, present, best }: FoundProps) {
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by keyboard
    <section class="tuning-runs tuning-scroll" tabIndex={0} aria-label={words.runs}>
      <table>
        <thead>
          <tr title={words.runHint}>
            <th scope="col">{words.run}</th>
            <th scope="col">{words.runCost}</th>
            <th scope="col">{words.runError}</th>
            <th scope="col">{words.runStiffness}</th>
            <th scope="col">{words.runTorqueChange}</th>
          </tr>
        </thead>
        <tbody>
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
                  {after.fault && <span class="is-fault"> {words.fault}</span>}
                </th>
                <td class="is-best">{formatPair(before.cost, after.cost)}</td>
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
            <td class="is-best">
              {words.arrow(formatNumber(present.cost), formatNumber(best.cost))}
            </td>
            <td colSpan={3} />
          </tr>
        </tbody>
      </table>
    </section>
  );
}
