import type { RunDifference } from "../../core/api/types";
import { t } from "../../core/text/t";
import { formatInput, toDegrees } from "../../core/units";

type Row = RunDifference["differences"][number];

function Group({ name, rows }: { name: string; rows: readonly Row[] }) {
  return (
    <tbody>
      <tr>
        <th scope="colgroup" class="hint strong" colSpan={1 + (rows[0]?.values.length ?? 0)}>
          {name}
        </th>
      </tr>
      {rows.map((row) => {
        const { unit, values } = formatSetting(row);
        return (
          <tr key={row.name}>
            <th scope="row">
              {row.name} {unit && <span class="unit">{unit}</span>}
            </th>
            {values.map((value, run) => (
              <td key={run}>{value}</td>
            ))}
          </tr>
        );
      })}
    </tbody>
  );
}

/** Only the settings that differ between these runs. */
export function DifferenceTable({ difference }: { difference: RunDifference }) {
  const { differences, titles } = difference;
  if (differences.length === 0) return <p class="muted">{t("difference.none")}</p>;
  const groups = [...new Set(differences.map(({ group }) => group))];
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by keyboard
    <section class="scroll overlay-table" tabIndex={0} aria-label={t("difference.title")}>
      <table class="metrics difference">
        <caption>
          <span>
            {t("difference.title")} <small class="unit">{t("difference.hint")}</small>
          </span>
        </caption>
        <thead>
          <tr>
            <td />
            {titles.map((title, run) => (
              <th key={difference.runs[run]} scope="col">
                {title}
              </th>
            ))}
          </tr>
        </thead>
        {groups.map((group) => (
          <Group key={group} name={group} rows={differences.filter((row) => row.group === group)} />
        ))}
      </table>
    </section>
  );
}

const NONE = "–";
const IN_DEGREES: Readonly<Record<string, string>> = { rad: "deg" };

export function formatSetting({ unit, values }: Row): { unit: string; values: string[] } {
  const shown = IN_DEGREES[unit];
  const format = (value: Row["values"][number]): string => {
    if (value === null) return NONE;
    if (typeof value === "boolean") return value ? t("difference.yes") : t("difference.no");
    if (typeof value === "string") return value;
    return formatInput(shown === undefined ? value : toDegrees(value), 6).replace("-", "−");
  };
  return { unit: shown ?? unit, values: values.map(format) };
}
