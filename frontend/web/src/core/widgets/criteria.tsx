/** Points and feedback by criterion. */
import type { Grade } from "../api/course";
import { text } from "../text/en";
import { Table } from "./tables";

const words = text.grades;

export const formatPoints = (points: number): string => String(Number(points.toFixed(2)));

export function Criteria({ grade }: { grade: Grade }) {
  return (
    <Table
      caption={<span class="visually-hidden">{words.criteria}</span>}
      heads={[words.asked, words.points, words.feedback]}
    >
      {grade.criteria.map((criterion) => (
        <tr key={`${criterion.step} ${criterion.name}`}>
          <th scope="row">{criterion.name}</th>
          <td class="nowrap">
            {words.of(formatPoints(criterion.points), formatPoints(criterion.max_points))}
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
          {words.run(run.run_id)} {run.description}
        </p>
      ))}
    </>
  );
}
