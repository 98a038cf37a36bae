import { bench } from "../state/plant";
import type { SampleRing } from "../stream/ring";
import { t } from "../text/t";
import { formatFixed, formatNumber } from "../units";
import { CHANNELS, type ChannelName, unitOf } from "./channels";
import { cursorSamples } from "./cursors";
import { readPiece, samplesOf, type Trace } from "./definitions";
import { Swatch } from "./legend";
import { titleOf } from "./plot";
import { type PlotSetup, setups, withoutMissing } from "./setups";
import { frozen, shownLaneSegments } from "./span";
import { type Measures, measureBetween } from "./statistics";
import { composeContent, tracesOf } from "./traces";

const COLUMNS = ["a", "b", "delta", "min", "max", "rms"] as const satisfies (keyof Measures)[];
const HEADS: Readonly<Record<(typeof COLUMNS)[number], string>> = {
  a: t("cursors.at", { name: t("cursors.names.a") }),
  b: t("cursors.at", { name: t("cursors.names.b") }),
  delta: t("cursors.delta"),
  min: t("cursors.min"),
  max: t("cursors.max"),
  rms: t("cursors.rms"),
};

const isTruth = ({ channel }: Trace) => CHANNELS[channel as ChannelName].truthOf !== undefined;

/** Every curve of a plot except for the opposite limits; true values are named after their lane. */
function curvesOf({ channels }: PlotSetup): Trace[] {
  const lanes = shownLaneSegments.value;
  const content = composeContent(withoutMissing(channels), lanes, bench.value !== null);
  const everything = new Set(content.groups.map((group) => group.key));
  return tracesOf(content, everything, lanes.length)
    .filter(({ factor }) => factor > 0)
    .map((curve) => {
      const name =
        lanes.length > 1 && isTruth(curve) ? lanes[curve.lane - 1]?.at(-1)?.name : undefined;
      return name === undefined
        ? curve
        : { ...curve, label: t("plots.ofLane", { lane: name, channel: curve.label }) };
    });
}

/** Statistics between the cursors, within the piece; null outside it. */
function measurePiece(ring: SampleRing, trace: Trace, [a, b]: RowsProps["indices"]) {
  const { first, end } = samplesOf(ring, trace, Math.min(a, b), Math.max(a, b) + 1);
  if (end <= first) return null;
  const within = [first, end - 1] as const;
  const measures = measureBetween(ring, trace.channel, trace.lane, within, trace.factor);
  const [atA, atB] = [readPiece(ring, trace, a), readPiece(ring, trace, b)];
  return { ...measures, a: atA, b: atB, delta: atB - atA };
}

interface RowsProps {
  setup: PlotSetup;
  indices: readonly [number, number];
}

function Rows({ setup, indices }: RowsProps) {
  const ring = frozen.value?.ring;
  if (ring === undefined) return null;
  return (
    <tbody>
      <tr>
        <th class="strong" scope="rowgroup" colSpan={COLUMNS.length + 1}>
          {titleOf(setup)} <span class="unit">{unitOf(setup.channels)}</span>
        </th>
      </tr>
      {curvesOf(setup).map((trace) => {
        const measures = measurePiece(ring, trace, indices);
        if (measures === null) return null;
        return (
          <tr key={trace.key}>
            <th scope="row">
              <Swatch look={trace} sign={trace.sign} />
              {trace.label}{" "}
              {measures.missingS > 0 && (
                <span class="bad" title={t("cursors.missingHint")}>
                  {t("cursors.missing", { seconds: formatNumber(measures.missingS, 3, 2) })}
                </span>
              )}
            </th>
            {COLUMNS.map((column) => (
              <td key={column}>{formatNumber(measures[column], 4, 4)}</td>
            ))}
          </tr>
        );
      })}
    </tbody>
  );
}

/** Statistics between the cursors, one row per curve. */
export function MeasureTable() {
  const indices = cursorSamples.value;
  const ring = frozen.value?.ring;
  if (indices === null || ring === undefined) return null;
  const [a, b] = [ring.timeAt(indices[0]), ring.timeAt(indices[1])];
  const lapse = b - a;
  return (
    <section class="column joined small tabular measures" aria-label={t("cursors.table")}>
      <dl class="row tight">
        <dt>{t("cursors.names.a")}</dt>
        <dd>{t("cursors.value", { time: formatFixed(a, 3) })}</dd>
        <dt>{t("cursors.names.b")}</dt>
        <dd>{t("cursors.value", { time: formatFixed(b, 3) })}</dd>
        <dt>{t("cursors.deltaTime")}</dt>
        <dd>{t("cursors.value", { time: formatNumber(lapse, 6, 3) })}</dd>
        <dt>{t("cursors.rate")}</dt>
        <dd>{formatNumber(lapse === 0 ? null : 1 / Math.abs(lapse), 4, 3)} Hz</dd>
      </dl>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reached by key */}
      <section class="scroller" tabIndex={0} aria-label={t("cursors.rows")}>
        <table class="metrics">
          <thead>
            <tr>
              <th scope="col">{t("cursors.curve")}</th>
              {COLUMNS.map((column) => (
                <th key={column} scope="col">
                  {HEADS[column]}
                </th>
              ))}
            </tr>
          </thead>
          {setups.value
            .filter(({ preset }) => preset !== "phase")
            .map((setup) => (
              <Rows key={setup.key} setup={setup} indices={indices} />
            ))}
        </table>
      </section>
    </section>
  );
}
