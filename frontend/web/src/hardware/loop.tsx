import type { LoopState } from "../core/api/types";
import { isLive } from "../core/state/session";
import { t } from "../core/text/t";
import { formatCount, formatLapse } from "../core/units";
import { barsOf, decadesIn } from "./status";

const WIDTH = 240;
const HEIGHT = 64;
const SIGNS = { ticking: "✓", starting: "◌", silent: "▲", gone: "▲", not_opened: "▲" } as const;
const LEVELS = {
  ticking: "good",
  starting: "",
  silent: "bad",
  gone: "bad",
  not_opened: "bad",
} as const;

/** Histogram of the lateness of ticks, with a logarithmic axis of counts. */
function Lateness({ loop }: { loop: LoopState }) {
  const { lateness_edges_s: edges, lateness_counts: counts } = loop;
  const bars = barsOf(edges, counts);
  const step = WIDTH / Math.max(1, bars.length);
  const decades = decadesIn(counts);
  const lines = Array.from({ length: Math.floor(decades) }, (_, power) => (power + 0.3) / decades);
  const label = t("bench.loop.histogram", {
    half: formatLapse(loop.lateness_p50_s),
    most: formatLapse(loop.lateness_p99_s),
    worst: formatLapse(loop.lateness_worst_s),
  });
  const shownEvery = Math.ceil(edges.length / 5);
  return (
    <figure class="drawing lateness">
      <svg viewBox={`0 0 ${WIDTH} ${HEIGHT + 14}`} role="img" aria-label={label}>
        {lines.map((line) => (
          <path key={line} class="grid" d={`M0 ${HEIGHT * (1 - line)}h${WIDTH}`} />
        ))}
        {bars.map(({ edgeS, count: ticks, height }, index) => (
          <rect
            key={edgeS ?? "above"}
            x={index * step + 1}
            y={HEIGHT * (1 - height)}
            width={Math.max(1, step - 2)}
            height={HEIGHT * height}
          >
            <title>
              {edgeS === null
                ? t("bench.loop.above", { ticks: formatCount(ticks) })
                : t("bench.loop.upTo", { edge: formatLapse(edgeS), ticks: formatCount(ticks) })}
            </title>
          </rect>
        ))}
        <path class="grid" d={`M0 ${HEIGHT}h${WIDTH}`} />
        {edges.map(
          (edge, index) =>
            index % shownEvery === shownEvery - 1 && (
              <text
                key={edge}
                x={(index + 1) * step}
                y={HEIGHT + 11}
                text-anchor={index + 1 < edges.length ? "middle" : "end"}
              >
                {formatLapse(edge)}
              </text>
            ),
        )}
      </svg>
      <figcaption class="hint">{t("bench.loop.counts")}</figcaption>
    </figure>
  );
}

/** The process that keeps the drives at zero current if the loop does not. */
function RestartInstructions({
  loop: { state, stopped_by: by, unreachable },
}: {
  loop: LoopState;
}) {
  if (state !== "silent" && state !== "gone") return null;
  return (
    <p class={by === null ? "bad" : ""}>
      {by === null ? t("bench.loop.notStopped") : t(`bench.loop.stoppedBy.${by}`)}
      {unreachable !== null && ` ${unreachable}`}
    </p>
  );
}

/** Timing of the loop's process, and its real-time privileges. */
export function Loop({ loop }: { loop: LoopState }) {
  const lapse = (seconds: number) =>
    loop.ticks === 0 ? t("bench.loop.noneYet") : formatLapse(seconds);
  const rows = [
    [t("bench.loop.quantiles.half"), lapse(loop.lateness_p50_s)],
    [t("bench.loop.quantiles.most"), lapse(loop.lateness_p99_s)],
    [t("bench.loop.quantiles.nearlyAll"), lapse(loop.lateness_p999_s)],
    [t("bench.loop.quantiles.worst"), lapse(loop.lateness_worst_s)],
    [t("bench.loop.cost"), lapse(loop.cost_p99_s)],
    [
      t("bench.loop.skipped"),
      t("bench.loop.of", {
        skipped: formatCount(loop.skipped_ticks),
        ticks: formatCount(loop.ticks),
      }),
    ],
  ] as const;
  return (
    <section class="surface small bench-card is-loop" aria-label={t("bench.loop.heading")}>
      <h2>
        {t("bench.loop.heading")}{" "}
        {isLive.value ? (
          <small class={LEVELS[loop.state]}>
            <span aria-hidden="true">{SIGNS[loop.state]}</span>{" "}
            {t(`bench.loop.states.${loop.state}`)}
            {loop.alive && `, ${t("status.rate", { hertz: Number(loop.rate_hz.toFixed(1)) })}`}
            {loop.silent_s !== null &&
              ` ${t("bench.loop.since", { lapse: formatLapse(loop.silent_s) })}`}
          </small>
        ) : (
          <small>{t("bench.drives.notKnown")}</small>
        )}
      </h2>
      {isLive.value && <RestartInstructions loop={loop} />}
      <div class="cells" style={{ "--cell": "150px" }}>
        <Lateness loop={loop} />
        <dl class="facts" aria-label={t("bench.loop.lateness")}>
          {rows.map(([name, value]) => (
            <div key={name}>
              <dt>{name}</dt>
              <dd>{value}</dd>
            </div>
          ))}
        </dl>
      </div>
      {loop.notes.length > 0 && (
        <ul class="row hint" aria-label={t("bench.loop.notes")}>
          {loop.notes.map((note) => (
            <li key={note}>{note}</li>
          ))}
        </ul>
      )}
    </section>
  );
}
