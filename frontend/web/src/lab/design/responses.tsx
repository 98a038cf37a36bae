import type { DesignResponse } from "../../core/api/design";
import { Swatch } from "../../core/plots/legend";
import { t } from "../../core/text/t";
import { formatNumber, toDegrees } from "../../core/units";
import { type Axis, type Curve, Curves, LOOKS } from "./curves";
import { isChanged } from "./draft";
import { currentResponse, draftResponse } from "./stability";
import { caveatOf } from "./words";

const TIME: Axis = { limits: [-0.1, 0.9], label: t("stability.time") };
const ERROR: Axis = { label: t("stability.error") };
const FREQUENCY: Axis = { limits: [0.1, 100], label: t("stability.frequency"), isLog: true };
const MAGNITUDE: Axis = { limits: [0.01, 30], label: t("stability.magnitude"), isLog: true };

type Points = Curve["points"];

const errorOf = ({ load }: DesignResponse): Points =>
  load.time_s.map((time, index) => [time, toDegrees(load.position_error_rad[index] as number)]);

const magnitudeOf = ({ disturbance }: DesignResponse): Points =>
  disturbance?.frequency_hz.map((frequency, index) => [
    frequency,
    toDegrees(disturbance.magnitude_rad_per_nm[index] as number),
  ]) ?? [];

const curveOf = (
  look: Curve["look"],
  response: DesignResponse,
  read: (response: DesignResponse) => Points,
): Curve => ({ look, points: read(response), isDoubtful: caveatOf(response) !== null });

function curvesOf(read: (response: DesignResponse) => Points): Curve[] {
  const now = currentResponse.value;
  const response = draftResponse.value;
  return [
    ...(now && isChanged.value ? [curveOf("present", now, read)] : []),
    ...(response ? [curveOf("tried", response, read)] : []),
  ];
}

/**
 * Responses to the 3 kg and to a sine on the link, with the draft's poles and with those in use.
 */
export function Responses() {
  const response = draftResponse.value;
  if (response === null) return <p class="hint">{t("design.asking")}</p>;
  const errors = curvesOf(errorOf);
  const magnitudes = curvesOf(magnitudeOf);
  const caveat = caveatOf(response);
  const doubt = caveat?.short ?? null;
  const earlier = currentResponse.value && caveatOf(currentResponse.value);
  const addCaveat = (summary: string) =>
    caveat ? t("stability.caveat", { summary, short: caveat.short }) : summary;
  const peak = formatNumber(toDegrees(response.load.peak_error_rad), 3, 2);
  return (
    <div class="halves wide">
      <div>
        <Curves
          title={t("stability.loadTitle")}
          summary={addCaveat(
            response.load.fault
              ? t("stability.loadSummaryFault", { peak, fault: response.load.fault })
              : t("stability.loadSummary", { peak }),
          )}
          x={TIME}
          y={ERROR}
          curves={errors}
          caveat={doubt}
        />
        {response.load.fault && (
          <p class="hint bad">{t("stability.loadFault", { fault: response.load.fault })}</p>
        )}
      </div>
      <Curves
        title={t("stability.bodeTitle")}
        summary={addCaveat(
          response.disturbance === null
            ? t("stability.noBode")
            : t("stability.bodeSummary", {
                most: formatNumber(
                  Math.max(0, ...magnitudeOf(response).map(([, value]) => value)),
                  3,
                  2,
                ),
              }),
        )}
        x={FREQUENCY}
        y={MAGNITUDE}
        curves={magnitudes}
        note={response.disturbance === null ? t("stability.bodeUnstable") : null}
        caveat={response.disturbance === null ? null : doubt}
      />
      {caveat && <p class="hint bad wide">{caveat.summary}</p>}
      <p class="row small wide" aria-hidden="true">
        <span>
          <Swatch look={LOOKS.tried} />{" "}
          {isChanged.value ? t("stability.tried") : t("stability.inUse")}
        </span>
        {isChanged.value && (
          <span>
            <Swatch look={LOOKS.present} />{" "}
            {earlier
              ? t("stability.lineStyles", { name: t("stability.inUse"), short: earlier.short })
              : t("stability.inUse")}
          </span>
        )}
      </p>
    </div>
  );
}
