/** The position error of a run, small: one path a lane, on one scale. */
import { readRun, readSamples } from "../../core/api/runs";
import type { RunDetails, RunSamples, StreamedName } from "../../core/api/types";
import { lineStyleOf } from "../../core/plots/linestyles";
import { text } from "../../core/text/en";
import { formatNumber, toDegrees } from "../../core/units";

const WIDTH = 300;
const HEIGHT = 44;
const POINTS = 240;
const MARGIN = 2;
const CHANNEL: StreamedName = "position_error_rad";
/** A smaller error than this fills no plot, rad. */
const SMALLEST = 1e-4;

interface Spark {
  /** One a segment of a lane, in the line style of who controlled it. */
  paths: { lineStyle: number; path: string }[];
  /** Height of zero error. */
  zero: number;
  /** Largest error of any lane, rad. */
  peak: number;
}

/** A run at a glance: its curves, and who controlled its lanes. */
export interface Glance extends Spark {
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
  const low = Math.min(-SMALLEST, ...values.map((value) => Math.min(0, value)));
  const high = Math.max(SMALLEST, ...values.map((value) => Math.max(0, value)));
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

const MAX_KEPT = 200;
const kept = new Map<string, Promise<Glance>>();

async function readGlance(run: string): Promise<Glance> {
  const [details, samples] = await Promise.all([readRun(run), readSamples(run, [CHANNEL], POINTS)]);
  const { lane_names: lanes, segments } = details;
  return { ...drawSpark(samples, segments), lanes, segments };
}

/** Read once a run and length; a run that is still recorded grows. */
export function keepGlance(run: string, ticks: number): Promise<Glance> {
  const key = `${run}.${ticks}`;
  const known = kept.get(key);
  if (known) return known;
  const made = readGlance(run);
  made.catch(() => kept.delete(key));
  kept.set(key, made);
  const oldest = kept.keys().next().value;
  if (kept.size > MAX_KEPT && oldest !== undefined) kept.delete(oldest);
  return made;
}

/** The position error of every lane over the whole run; nothing until it is read. */
export function Sparkline({ glance }: { glance: Glance | null }) {
  const label = glance
    ? text.runs.sparkline(glance.lanes.join(", "), formatNumber(toDegrees(glance.peak), 2, 3))
    : text.runs.noSparkline;
  return (
    <svg
      class="sparkline"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      preserveAspectRatio="none"
      role="img"
      aria-label={label}
    >
      {glance && <path class="spark-zero" d={`M0 ${glance.zero}H${WIDTH}`} />}
      {glance?.paths
        .map(({ lineStyle: number, path }, index) => {
          const lineStyle = lineStyleOf(number);
          return (
            <path
              key={index}
              style={{ stroke: `var(--plot-${lineStyle.colour})` }}
              d={path}
              stroke-dasharray={lineStyle.dash.join(" ") || undefined}
            />
          );
        })
        .reverse()}
    </svg>
  );
}
