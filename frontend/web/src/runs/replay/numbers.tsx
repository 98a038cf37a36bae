import type { Metrics as LaneMetrics } from "../../core/api/types";
import { AllMetrics } from "../../core/plots/allmetrics";
import { lineStyleAt, lineStyleOfLane } from "../../core/plots/linestyles";
import { type MetricsColumn, MetricsTable } from "../../core/plots/metricstable";
import { t } from "../../core/text/t";

import { formatFixed, formatNumber, toDegrees } from "../../core/units";
import { describeMeasured, explainSteadyState, isDisturbed } from "../list/measured";
import { isPlaying, seek } from "./clock";
import type { Recording, Run } from "./data";

const formatMetric = (value: number | null) => formatNumber(value, 3, 4);
const formatError = (rad: number | null) => formatMetric(rad === null ? null : toDegrees(rad));

/** Controller of the lane in the window. */
const lineStyleIn = ({ segments, window }: Run, lane: number): number =>
  lineStyleAt(segments[lane], window.start_s) ?? lane;

/** Number of the lanes that are not comparisons. */
const ownLanes = ({ arm }: Run): number => arm?.chain.length ?? 1;

function Metrics({ run }: { run: Run }) {
  const { window, metrics } = run;
  const cell =
    (read: (row: LaneMetrics) => number | null, format = formatError) =>
    (lane: number) => {
      const row = metrics[lane];
      return format(row === undefined ? null : read(row));
    };
  const columns: MetricsColumn[] = [
    { key: "rms", title: t("replay.numbers.rms"), cell: cell((row) => row.rms_position_error_rad) },
    {
      key: "peak",
      title: t("replay.numbers.peak"),
      cell: cell((row) => row.peak_position_error_rad),
    },
    {
      key: "settled",
      title: t("replay.numbers.settled"),
      hint: explainSteadyState(window),
      cell: cell((row) => row.steady_state_position_error_rad),
    },
    {
      key: "rms stiffness",
      title: t("replay.numbers.rms"),
      cell: cell((row) => row.rms_stiffness_error_nm_per_rad, formatMetric),
    },
    {
      key: "peak stiffness",
      title: t("replay.numbers.peak"),
      cell: cell((row) => row.peak_stiffness_error_nm_per_rad, formatMetric),
    },
  ];
  const group = (name: string, unit: string, count: number) => ({
    title: (
      <>
        {name} <span class="unit">{unit}</span>
      </>
    ),
    columns: count,
  });
  return (
    <MetricsTable
      class="metrics strong"
      caption={t("replay.numbers.heading", { window: describeMeasured(window) })}
      captionHint={t("replay.numbers.hint")}
      corner={<span class="visually-hidden">{t("replay.numbers.lane")}</span>}
      groups={[
        group(t("replay.numbers.position"), t("replay.numbers.degrees"), 3),
        group(t("replay.numbers.stiffness"), t("replay.numbers.stiffnessUnit"), 2),
      ]}
      rows={window.lanes.map((name, index) => ({
        key: `${index}.${name}`,
        look: lineStyleOfLane(lineStyleIn(run, index), index < ownLanes(run)),
        name,
      }))}
      columns={columns}
    />
  );
}

function Details({ run }: { run: Run }) {
  const { window, metrics } = run;
  const lanes = window.lanes.map((name, index) => ({
    key: `${index}.${name}`,
    look: lineStyleOfLane(lineStyleIn(run, index), index < ownLanes(run)),
    name,
    metrics: metrics[index] ?? null,
    isDisturbed: isDisturbed(window),
  }));
  return (
    <details class="small">
      <summary>{t("metrics.all")}</summary>
      <AllMetrics caption={describeMeasured(window)} lanes={lanes} />
    </details>
  );
}

function Events({ run }: { run: Run }) {
  return (
    <div class="menu small divided">
      <h2>{t("replay.events.heading")}</h2>
      {run.events.length === 0 && <p class="hint">{t("replay.events.none")}</p>}
      <ul>
        {run.events.map((event, index) => (
          <li key={`${index}.${event.label}`}>
            <button
              type="button"
              aria-label={t("replay.events.jump", {
                time: t("replay.transport.seconds", { seconds: formatFixed(event.time_s, 2) }),
                label: event.label,
              })}
              onClick={() => {
                isPlaying.value = false;
                seek(event.time_s);
              }}
            >
              <span class="number hint">
                {t("replay.transport.seconds", { seconds: formatFixed(event.time_s, 2) })}
              </span>{" "}
              {event.label}
            </button>
          </li>
        ))}
      </ul>
    </div>
  );
}

export function Numbers({ recording: { run } }: { recording: Recording }) {
  return (
    <section class="surface replay-numbers">
      <Metrics run={run} />
      <Details run={run} />
      <Events run={run} />
    </section>
  );
}
