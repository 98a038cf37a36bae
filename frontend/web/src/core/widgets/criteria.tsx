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
      {grade.criteria.map((one) => (
        <tr key={`${one.step} ${one.name}`}>
          <th scope="row">{one.name}</th>
          <td class="nowrap">{words.of(formatPoints(one.points), formatPoints(one.max_points))}</td>
          <td class="as-written">{one.feedback}</td>
        </tr>
      ))}
    </Table>
  );
}

/** Result of the verification of the submitted runs. */
export function VerifiedRuns({ grade }: { grade: Grade }) {
  return (
    <>
      {(grade.runs ?? []).map((one) => (
        <p key={one.run_id} class="hint">
          {words.run(one.run_id)} {one.description}
        </p>
      ))}
    </>
  );
}
