import type { StudyRow } from "../../core/api/studies";
import { writeFault } from "../../core/state/faults";
import { titleOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { showRuns } from "./selectedruns";
import { selectedRows, study } from "./selection";
import { isBusy } from "./studies";
import { factorOf, nameColumn } from "./studyview";

const outcomeOf = (row: StudyRow): string =>
  row.fault !== null
    ? t("studies.outcome.fault", { code: writeFault(String(row.fault)) })
    : row.succeeded
      ? t("studies.outcome.good")
      : t("studies.outcome.missed");

function Cell({ row, name, unit }: { row: StudyRow; name: string; unit: string }) {
  const value = row[name];
  return (
    <td>{typeof value === "number" ? formatNumber(value * factorOf(unit), 4) : (value ?? "–")}</td>
  );
}

/** The selected run: settings, result, and a link to its 3D view. */
export function SelectedRun() {
  const rows = selectedRows.value;
  const columns = (study.value?.columns ?? []).filter(
    ({ role }) => role === "varied" || role === "metric",
  );
  const numbers = rows.map((row) => Number(row.row));
  return (
    <section
      class="surface card wide"
      aria-label={t("studies.row", { row: numbers.at(-1) ?? 0 })}
      aria-live="polite"
    >
      {rows.length === 0 ? (
        <p class="hint">{t("studies.pickHint")}</p>
      ) : (
        <>
          <table class="table">
            <thead>
              <tr>
                <td />
                {rows.map((row) => (
                  <th key={Number(row.row)} scope="col">
                    {t("studies.row", { row: Number(row.row) })}
                    <small class="block">
                      {titleOf(String(row.law))}, {outcomeOf(row)}
                    </small>
                    <button
                      type="button"
                      class="button"
                      title={t("studies.seeHint")}
                      disabled={isBusy.value !== ""}
                      onClick={() => void showRuns([Number(row.row)])}
                    >
                      {t("studies.see")}
                    </button>
                  </th>
                ))}
              </tr>
            </thead>
            <tbody>
              {columns.map(({ name, label, unit }) => (
                <tr key={name}>
                  <th scope="row">{nameColumn({ label, unit })}</th>
                  {rows.map((row) => (
                    <Cell key={Number(row.row)} row={row} name={name} unit={unit} />
                  ))}
                </tr>
              ))}
            </tbody>
          </table>
          {rows.length > 1 && (
            <button
              type="button"
              class="button"
              disabled={isBusy.value !== ""}
              onClick={() => void showRuns(numbers)}
            >
              {t("studies.overlay")}
            </button>
          )}
          {isBusy.value === "see" && <p role="status">{t("studies.seeing")}</p>}
        </>
      )}
    </section>
  );
}
