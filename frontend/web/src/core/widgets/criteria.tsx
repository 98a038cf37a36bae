/** Points by criterion, with what was told of each. */
import type { Grade } from "../api/course";
import { text } from "../text/en";

const words = text.grades;

export const formatPoints = (points: number): string => String(Number(points.toFixed(2)));

export function Criteria({ grade }: { grade: Grade }) {
  return (
    <table class="desk-table criteria">
      <caption class="visually-hidden">{words.criteria}</caption>
      <thead>
        <tr>
          <th scope="col">{words.asked}</th>
          <th scope="col">{words.points}</th>
          <th scope="col">{words.feedback}</th>
        </tr>
      </thead>
      <tbody>
        {grade.criteria.map((one) => (
          <tr key={`${one.step} ${one.name}`}>
            <th scope="row">{one.name}</th>
            <td class="criteria-points">
              {words.of(formatPoints(one.points), formatPoints(one.max_points))}
            </td>
            <td>{one.feedback}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** What was verified of the runs that were submitted. */
export function VerifiedRuns({ grade }: { grade: Grade }) {
  return (
    <>
      {(grade.runs ?? []).map((one) => (
        <p key={one.run_id} class="hint criteria-run">
          {words.run(one.run_id)} {one.description}
        </p>
      ))}
    </>
  );
}
