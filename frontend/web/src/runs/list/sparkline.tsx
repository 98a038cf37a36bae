/** The position error of a run as a small plot: one path per lane, with a common scale. */
import { readRun, readSamples } from "../../core/api/runs";
import type { RunDetails, RunSamples, StreamedName } from "../../core/api/types";
import { lineStyleOf } from "../../core/plots/linestyles";
import { t } from "../../core/text/t";
import { formatNumber, toDegrees } from "../../core/units";

const WIDTH = 300;
const HEIGHT = 44;
const POINTS = 240;
const MARGIN = 2;
const CHANNEL: StreamedName = "position_error_rad";
/** Minimum range of the plot, rad. */
const MIN_RANGE = 1e-4;

interface Spark {
  /** One per segment of a lane, in the line style of its controller. */
  paths: { lineStyle: number; path: string }[];
  /** Vertical position of zero error. */
  zero: number;
  /** Largest error of any lane, rad. */
  peak: number;
}

/** Overview of a run: its curves, and the controllers of its lanes. */
export interface RunOverview extends Spark {
  lanes: string[];
  segments: Segments;
}

type Segments = RunDetails["segments"];
type Segment = Segments[number][number];

export function drawSpark(
  { time_s: time, lanes }: Pick<RunSamples, "time_s" | "lanes">,
  segments: Segments,
): Spark {
  const curves = Object.values(lanes).map((channels) => channels[CHANNEL] ?? []);
  const values = curves.flat().filter((value) => value !== null);
  const peak = values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  const low = Math.min(-MIN_RANGE, ...values.map((value) => Math.min(0, value)));
  const high = Math.max(MIN_RANGE, ...values.map((value) => Math.max(0, value)));
  const first = time[0] ?? 0;
  const span = Math.max((time.at(-1) ?? 1) - first, 1e-9);
  const across = (seconds: number) => ((seconds - first) / span) * WIDTH;
  const down = (value: number) => MARGIN + ((high - value) / (high - low)) * (HEIGHT - 2 * MARGIN);
  const draw = (curve: readonly (number | null)[], { start_s: from, end_s: to }: Segment) => {
    let isDown = false;
    return curve
      .map((value, index) => {
        const at = time[index] ?? 0;
        if (value === null || at < from || (to !== null && at >= to)) {
          isDown = false;
          return "";
        }
        const command = isDown ? "L" : "M";
        isDown = true;
        return `${command}${across(at).toFixed(1)} ${down(value).toFixed(1)}`;
      })
      .join("");
  };
  const paths = curves.flatMap((curve, lane) =>
    (segments[lane] ?? []).map((segment) => ({
      lineStyle: segment.line_style,
      path: draw(curve, segment),
    })),
  );
  return { paths, zero: down(0), peak };
}

const MAX_CACHED = 200;
const cache = new Map<string, Promise<RunOverview>>();

async function fetchOverview(run: string): Promise<RunOverview> {
  const [details, samples] = await Promise.all([readRun(run), readSamples(run, [CHANNEL], POINTS)]);
  const { lane_names: lanes, segments } = details;
  return { ...drawSpark(samples, segments), lanes, segments };
}

/** Read once per run and length; a run that is being recorded grows. */
export function readOverview(run: string, ticks: number): Promise<RunOverview> {
  const key = `${run}.${ticks}`;
  const cached = cache.get(key);
  if (cached) return cached;
  const request = fetchOverview(run);
  request.catch(() => cache.delete(key));
  cache.set(key, request);
  const oldest = cache.keys().next().value;
  if (cache.size > MAX_CACHED && oldest !== undefined) cache.delete(oldest);
  return request;
}

/** The position error of every lane over the whole run; nothing until it is read. */
export function Sparkline({ overview }: { overview: RunOverview | null }) {
  const label = overview
    ? t("runs.sparkline", {
        lanes: overview.lanes.join(", "),
        peak: formatNumber(toDegrees(overview.peak), 2, 3),
      })
    : t("runs.noSparkline");
  return (
    <svg
      class="drawing"
      height="20"
      fill="none"
      stroke-width="1.4"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      preserveAspectRatio="none"
      role="img"
      aria-label={label}
    >
      {overview && (
        <path class="grid" vector-effect="non-scaling-stroke" d={`M0 ${overview.zero}H${WIDTH}`} />
      )}
      {overview?.paths
        .map(({ lineStyle: number, path }, index) => {
          const lineStyle = lineStyleOf(number);
          return (
            <path
              key={index}
              style={{ stroke: `var(--plot-${lineStyle.colour})` }}
              d={path}
              vector-effect="non-scaling-stroke"
              stroke-dasharray={lineStyle.dash.join(" ") || undefined}
            />
          );
        })
        .reverse()}
    </svg>
  );
}
