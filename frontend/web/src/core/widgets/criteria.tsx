/** Points and feedback by criterion. */

import type { Grade } from "../api/course";
import { t } from "../text/t";
import { formatInput } from "../units";
import { Table } from "./tables";

export const formatPoints = (points: number): string => formatInput(Number(points.toFixed(2)), 15);

export function Criteria({ grade }: { grade: Grade }) {
  return (
    <Table
      caption={<span class="visually-hidden">{t("grades.criteria")}</span>}
      heads={[t("grades.asked"), t("grades.points"), t("grades.feedback")]}
    >
      {grade.criteria.map((criterion) => (
        <tr key={`${criterion.step} ${criterion.name}`}>
          <th scope="row">{criterion.name}</th>
          <td class="nowrap">
            {t("grades.of", {
              points: formatPoints(criterion.points),
              most: formatPoints(criterion.max_points),
            })}
          </td>
          <td class="as-written">{criterion.feedback}</td>
        </tr>
      ))}
    </Table>
  );
}

/** Result of the verification of the submitted runs. */
export function VerifiedRuns({ grade }: { grade: Grade }) {
  return (
    <>
      {(grade.runs ?? []).map((run) => (
        <p key={run.run_id} class="hint">
          {t("grades.run", { id: run.run_id })} {run.description}
        </p>
      ))}
    </>
  );
}
