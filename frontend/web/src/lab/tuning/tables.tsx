import type { Candidate, Tuning } from "../../core/api/jobs";
import { t } from "../../core/text/t";
import { formatInput, formatNumber } from "../../core/units";
import { MathSymbol } from "../../core/widgets/symbol";
import { Table } from "../../core/widgets/tables";

interface FoundProps {
  tuning: Tuning;
  present: Candidate;
  best: Candidate;
}

/** Every tuned number: initial value, best value, range. */
export function ValueTable({ tuning, present, best }: FoundProps) {
  return (
    <Table
      label={t("tuning.values")}
      look="metrics"
      heads={[t("tuning.parameter"), t("tuning.before"), t("tuning.tuned"), t("tuning.range")]}
    >
      {tuning.axes.map((axis, index) => (
        <tr key={axis.name}>
          <th scope="row" title={axis.name}>
            <i>
              <MathSymbol text={axis.symbol} />
            </i>{" "}
            <small>{axis.unit === "1" ? "" : axis.unit}</small>
          </th>
          <td>{formatInput(present.values[index] ?? 0, 4)}</td>
          <td class="strong">{formatInput(best.values[index] ?? 0, 4)}</td>
          <td class="muted">{`${formatInput(axis.low, 3)} – ${formatInput(axis.high, 3)}`}</td>
        </tr>
      ))}
    </Table>
  );
}

const write = (value: number | null): string => (value === null ? "–" : formatNumber(value));

/** Results of the current and of the best parameters: on validation trials once it has ended. */
export function ResultTable({ tuning, present, best }: FoundProps) {
  const before = tuning.finals.find(({ number }) => number === present.number) ?? present;
  const rows = [
    { name: t("tuning.before"), result: before },
    { name: t("tuning.tuned"), result: best },
  ];
  return (
    <div class="wide">
      <Table
        label={t("tuning.results")}
        look="metrics"
        caption={tuning.finals.length > 0 ? t("tuning.onValidation") : t("tuning.onTraining")}
        heads={t("tuning.resultHeads", { returnObjects: true })}
      >
        {rows.map(({ name, result }) => (
          <tr key={name}>
            <th scope="row">{name}</th>
            <td class="strong">{formatNumber(result.cost)}</td>
            <td>
              {result.trials === 0
                ? t("tuning.tooNoisy")
                : t("tuning.held", { held: result.held, trials: result.trials })}
            </td>
            <td>{write(result.position_error_deg)}</td>
            <td>{write(result.stiffness_error_percent)}</td>
            <td>{write(result.torque_variation_nm_per_s)}</td>
          </tr>
        ))}
      </Table>
      {tuning.noise_limit_nm_per_s !== null && (
        <p class="hint">
          {t("tuning.noiseLimit", { limit: formatNumber(tuning.noise_limit_nm_per_s) })}
        </p>
      )}
    </div>
  );
}
