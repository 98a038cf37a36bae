/** The datasheet of an actuator, measured by the server. */
import { useEffect, useState } from "preact/hooks";
import { type Datasheet, datasheetAddress, readDatasheet } from "../../core/api/actuators";
import type { ActuatorRow } from "../../core/api/types";
import { explain } from "../../core/state/actions";
import { t } from "../../core/text/t";
import { formatNumber, toDegrees } from "../../core/units";
import { ErrorLine } from "../../core/widgets/form";
import { Table } from "../../core/widgets/tables";
import { type Curve, Curves } from "../design/curves";

type Points = readonly (readonly [number, number])[];

const curveOf = (points: Points, look: Curve["look"] = "tried"): Curve => ({ look, points });

function Plots({ datasheet }: { datasheet: Datasheet }) {
  const deflection = { label: t("actuators.deflection") };
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
          title={t("actuators.torque")}
          summary={t("actuators.summary", { what: t("actuators.torque"), count })}
          x={deflection}
          y={{ label: t("actuators.torqueAxis") }}
          curves={overDeflection("torque_nm")}
        />
        <Curves
          title={t("actuators.stiffness")}
          summary={t("actuators.summary", { what: t("actuators.stiffness"), count })}
          x={deflection}
          y={{ label: t("actuators.stiffnessAxis") }}
          curves={overDeflection("stiffness_at_nm_per_rad")}
        />
        <Curves
          title={t("actuators.workspace")}
          summary={t("actuators.summary", { what: t("actuators.workspace"), count: 2 })}
          x={{ label: t("actuators.torqueAxis") }}
          y={{ label: t("actuators.stiffnessAxis") }}
          curves={bounds}
        />
        {datasheet.torque_speed.length > 0 && (
          <Curves
            title={t("actuators.speeds")}
            summary={t("actuators.summary", { what: t("actuators.speeds"), count: 1 })}
            x={{ label: t("actuators.speed") }}
            y={{ label: t("actuators.torqueAxis") }}
            curves={[curveOf(datasheet.torque_speed.map(([speed, torque]) => [speed, torque]))]}
          />
        )}
      </div>
      <p class="hint">
        {t("actuators.presets", {
          sigmas: datasheet.presets
            .map((preset) => formatNumber(preset.stiffness_nm_per_rad, 3))
            .join(", "),
        })}
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
    <section class="surface stack card" aria-label={t("actuators.datasheet")}>
      <div class="spread">
        <div>
          <h3>{t("actuators.datasheet")}</h3>
          <p class="hint">{t("actuators.datasheetLead")}</p>
        </div>
        <p class="row">
          <a class="button" href={datasheetAddress(name, "pdf")} download>
            {t("actuators.pdf")}
          </a>
          <a class="button" href={datasheetAddress(name, "json")} download>
            {t("actuators.json")}
          </a>
        </p>
      </div>
      <ErrorLine>{problem}</ErrorLine>
      {datasheet === null ? (
        problem === "" && <p class="hint">{t("actuators.measuring")}</p>
      ) : (
        <>
          <Table
            label={t("actuators.datasheet")}
            heads={[t("actuators.quantity"), t("actuators.value")]}
          >
            {datasheet.rows.map(([quantity, value]) => (
              <tr key={quantity}>
                <th scope="row">{quantity}</th>
                <td>{value}</td>
              </tr>
            ))}
          </Table>
          <h4>{t("actuators.published")}</h4>
          {datasheet.published_rows.length === 0 ? (
            <p class="hint">{t("actuators.unpublished")}</p>
          ) : (
            <ul class="bullets" aria-label={t("actuators.published")}>
              {datasheet.published_rows.map(
                ([quantity, measured, published, deviation, source]) => (
                  <li key={quantity}>
                    {quantity}: {t("actuators.comparison", { measured, published, deviation })}
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
