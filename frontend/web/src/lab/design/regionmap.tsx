import { useId, useState } from "preact/hooks";
import { explain } from "../../core/state/actions";
import { settings } from "../../core/state/arm";
import { titleOf, usableLaws } from "../../core/state/laws";
import { findStiffness } from "../../core/state/stiffness";
import { t } from "../../core/text/t";
import { formatNumber, roundTo } from "../../core/units";
import { ErrorLine, SelectField } from "../../core/widgets/form";
import { NumberField } from "../../core/widgets/numberinput";
import {
  computeRegion,
  isComputing,
  isOutdated,
  outcomes,
  problem,
  restShare,
  type Slice,
  STARTS,
  shownRegion,
  stopComputing,
} from "./region";
import { draftResponse } from "./stability";

const WIDTH = 340;
const HEIGHT = 190;
const LEFT = 34;
const BOTTOM = 30;
const TOP = 4;
const RIGHT = 8;
const CELL_X = (WIDTH - LEFT - RIGHT) / STARTS;
const CELL_Y = (HEIGHT - TOP - BOTTOM) / STARTS;
const POSITIONS = [-90, -45, 0, 45, 90];
const VELOCITIES = [-20, -10, 0, 10, 20];
const LOOKS = ["rest", "fault", "unsettled"] as const;
const SLICES: readonly Slice[] = ["rigid", "deflected"];

const placeX = (degrees: number) =>
  LEFT + CELL_X / 2 + ((degrees + 90) / 180) * (WIDTH - LEFT - RIGHT - CELL_X);
const placeY = (speed: number) =>
  HEIGHT - BOTTOM - CELL_Y / 2 - ((speed + 20) / 40) * (HEIGHT - TOP - BOTTOM - CELL_Y);
const written = (value: number) => String(value).replace("-", "\u2212");

/** One path per color: a thousand cells are three elements. */
function pathOf(look: (typeof LOOKS)[number]): string {
  return outcomes.value
    .filter(({ outcome }) => outcome === look)
    .map(({ row, column }) => {
      const x = LEFT + column * CELL_X;
      const y = HEIGHT - BOTTOM - (row + 1) * CELL_Y;
      return `M${x.toFixed(2)} ${y.toFixed(2)}h${CELL_X.toFixed(2)}v${CELL_Y.toFixed(2)}h${(-CELL_X).toFixed(2)}z`;
    })
    .join("");
}

const percent = (part: number) => `${formatNumber(100 * part, 3, 1)} %`;

function Picture() {
  const region = shownRegion.value;
  const part = restShare.value;
  const summary =
    region === null || part === null
      ? t("stability.regionEmpty")
      : t("stability.regionSummary", {
          stiffness: formatNumber(region.stiffness_nm_per_rad, 3, 1),
          share: percent(part),
        });
  return (
    <svg
      class="drawing region-map"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      role="img"
      aria-label={summary}
    >
      <rect
        class="grid region-ground"
        x={LEFT}
        y={TOP}
        width={WIDTH - LEFT - RIGHT}
        height={HEIGHT - TOP - BOTTOM}
      />
      {LOOKS.map((look) => (
        <path key={look} class={`solid is-${look}`} d={pathOf(look)} />
      ))}
      <path
        class="outline"
        stroke-dasharray="2 3"
        opacity="0.5"
        d={`M${placeX(0)} ${TOP}V${HEIGHT - BOTTOM}M${LEFT} ${placeY(0)}H${WIDTH - RIGHT}`}
      />
      {POSITIONS.map((degrees) => (
        <text key={degrees} x={placeX(degrees)} y={HEIGHT - BOTTOM + 13} text-anchor="middle">
          {written(degrees)}°
        </text>
      ))}
      {VELOCITIES.map((speed) => (
        <text key={speed} x={LEFT - 4} y={placeY(speed) + 4} text-anchor="end">
          {written(speed)}
        </text>
      ))}
      <text x={WIDTH - RIGHT} y={HEIGHT - 3} text-anchor="end">
        {t("stability.regionAxes")}
      </text>
    </svg>
  );
}

function describeRegion(share: string, done: number, sensing: string): string {
  const all = STARTS * STARTS;
  const shares =
    done === all
      ? t("stability.regionFound", { share, all, sensing })
      : t("stability.regionSoFar", { share, done, all, sensing });
  return isOutdated.value ? shares + t("stability.regionOutdated") : shares;
}

/** Region of attraction: a map that fills while it is computed. */
export function RegionMap() {
  const id = useId();
  const configuration = settings.value?.configuration;
  const own = configuration?.law ?? "ndobc";
  const [law, setLaw] = useState<string | null>(null);
  const [chosen, setChosen] = useState<Slice>("rigid");
  const [typed, setTyped] = useState<number | null>(null);
  const present =
    draftResponse.value?.stiffness_nm_per_rad ?? (configuration && findStiffness(configuration));
  const sigma = typed ?? roundTo(present ?? 0, 3);
  const limits = configuration?.limits;
  const part = restShare.value;
  const region = shownRegion.value;
  return (
    <section
      class={`stack region ${isOutdated.value ? "is-outdated" : ""}`}
      aria-labelledby={`${id}-title`}
    >
      <h3 id={`${id}-title`} title={t("stability.regionHint")}>
        {t("stability.region")}
      </h3>
      <form
        class="row small form"
        onSubmit={(event) => {
          event.preventDefault();
          void computeRegion(law ?? own, chosen, sigma);
        }}
      >
        <SelectField
          label={t("stability.law")}
          value={law ?? own}
          options={usableLaws.value.map(({ name }) => name)}
          name={titleOf}
          disabled={isComputing.value}
          onChoose={setLaw}
        />
        <SelectField
          label={t("stability.slice")}
          value={chosen}
          options={SLICES}
          name={(slice) => t(`stability.slices.${slice}`)}
          disabled={isComputing.value}
          onChoose={setChosen}
        />
        <NumberField
          label="σ"
          labelRest={t("stability.regionStiffness")}
          unit="N·m/rad"
          min={limits?.stiffness_min_nm_per_rad}
          max={limits?.stiffness_max_nm_per_rad}
          value={sigma}
          disabled={isComputing.value}
          onInput={setTyped}
        />
        {isComputing.value ? (
          <button type="button" class="button end" onClick={stopComputing}>
            {t("stability.stop")}
          </button>
        ) : (
          <button type="submit" class="button end">
            {t("stability.fill")}
          </button>
        )}
      </form>
      <ErrorLine>{problem.value === null ? "" : explain(problem.value)}</ErrorLine>
      <Picture />
      <p class="row small">
        {LOOKS.map((look) => (
          <span key={look} class={`is-${look}`}>
            <i class="dot" />
            {t(`stability.looks.${look}`)}
          </span>
        ))}
      </p>
      <p class="hint">
        {t("stability.regionCaption", {
          slice: t(`stability.slices.${region?.chosen ?? chosen}`),
          starts: STARTS,
        })}
      </p>
      <p class="hint" role={isComputing.value ? undefined : "status"}>
        {region === null || part === null
          ? t("stability.regionEmpty")
          : describeRegion(
              percent(part),
              outcomes.value.length,
              t(`stability.sensing.${region.encoders}`),
            )}
      </p>
    </section>
  );
}
