/** The datasheet of an actuator, measured by the server. */
import { useEffect, useState } from "preact/hooks";
import { type Datasheet, datasheetAddress, readDatasheet } from "../../core/api/actuators";
import type { ActuatorRow } from "../../core/api/types";
import { explain } from "../../core/state/actions";
import { text } from "../../core/text/en";
import { formatNumber, toDegrees } from "../../core/units";
import { ErrorLine } from "../../core/widgets/form";
import { Table } from "../../core/widgets/tables";
import { type Curve, Curves } from "../design/curves";

const words = text.actuators;
type Points = readonly (readonly [number, number])[];

const curveOf = (points: Points, look: Curve["look"] = "tried"): Curve => ({ look, points });

function Plots({ datasheet }: { datasheet: Datasheet }) {
  const deflection = { label: words.deflection };
  const overDeflection = (key: "torque_nm" | "stiffness_at_nm_per_rad") =>
    datasheet.presets.map((preset) =>
      curveOf(preset.deflection_rad.map((rad, at) => [toDegrees(rad), preset[key][at] ?? 0])),
    );
  const bounds = [1, 2].map((place) =>
    curveOf(datasheet.torque_stiffness.map((row) => [row[0], row[place] ?? 0])),
  );
  const count = datasheet.presets.length;
  return (
    <>
      <div class="cells">
        <Curves
          title={words.torque}
          summary={words.summary(words.torque, count)}
          x={deflection}
          y={{ label: words.torqueAxis }}
          curves={overDeflection("torque_nm")}
        />
        <Curves
          title={words.stiffness}
          summary={words.summary(words.stiffness, count)}
          x={deflection}
          y={{ label: words.stiffnessAxis }}
          curves={overDeflection("stiffness_at_nm_per_rad")}
        />
        <Curves
          title={words.workspace}
          summary={words.summary(words.workspace, 2)}
          x={{ label: words.torqueAxis }}
          y={{ label: words.stiffnessAxis }}
          curves={bounds}
        />
        {datasheet.torque_speed.length > 0 && (
          <Curves
            title={words.speeds}
            summary={words.summary(words.speeds, 1)}
            x={{ label: words.speed }}
            y={{ label: words.torqueAxis }}
            curves={[curveOf(datasheet.torque_speed.map(([speed, torque]) => [speed, torque]))]}
          />
        )}
      </div>
      <p class="hint">
        {words.presets(
          datasheet.presets
            .map((preset) => formatNumber(preset.stiffness_nm_per_rad, 3))
            .join(", "),
        )}
      </p>
    </>
  );
}

export function DatasheetCard({ actuator: { name } }: { actuator: ActuatorRow }) {
  const [datasheet, setDatasheet] = useState<Datasheet | null>(null);
  const [problem, setProblem] = useState("");
  useEffect(() => {
    let isGone = false;
    readDatasheet(name).then(
      (answer) => {
        if (!isGone) setDatasheet(answer);
      },
      (error: unknown) => {
        if (!isGone) setProblem(explain(error));
      },
    );
    return () => {
      isGone = true;
    };
  }, [name]);
  return (
    <section class="surface stack card" aria-label={words.datasheet}>
      <div class="spread">
        <div>
          <h3>{words.datasheet}</h3>
          <p class="hint">{words.datasheetLead}</p>
        </div>
        <p class="row">
          <a class="button" href={datasheetAddress(name, "pdf")} download>
            {words.pdf}
          </a>
          <a class="button" href={datasheetAddress(name, "json")} download>
            {words.json}
          </a>
        </p>
      </div>
      <ErrorLine>{problem}</ErrorLine>
      {datasheet === null ? (
        problem === "" && <p class="hint">{words.measuring}</p>
      ) : (
        <>
          <Table label={words.datasheet} heads={[words.quantity, words.value]}>
            {datasheet.rows.map(([quantity, value]) => (
              <tr key={quantity}>
                <th scope="row">{quantity}</th>
                <td>{value}</td>
              </tr>
            ))}
          </Table>
          <h4>{words.published}</h4>
          {datasheet.published_rows.length === 0 ? (
            <p class="hint">{words.unpublished}</p>
          ) : (
            <ul class="bullets" aria-label={words.published}>
              {datasheet.published_rows.map(
                ([quantity, measured, published, deviation, source]) => (
                  <li key={quantity}>
                    {quantity}: {words.comparison(measured, published, deviation)}
                    <p class="hint">{source}</p>
                  </li>
                ),
              )}
            </ul>
          )}
          <Plots datasheet={datasheet} />
        </>
      )}
    </section>
  );
}
