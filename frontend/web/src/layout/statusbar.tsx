import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { BenchState, SessionState } from "../core/api/types";
import { isLive, missedSamples, phase, samples, session } from "../core/state/session";
import { t } from "../core/text/t";
import { formatLapse, formatNumber, formatSeconds, formatTime } from "../core/units";
import { useLiveText } from "../core/widgets/live";
import { isStarting } from "../hardware/status";
import { ControlCell } from "../lab/lease/cell";
import { StopButton } from "../lab/safety/stopbanner";
import { isLabShown, place } from "../runs/list/place";
import { CornerMark } from "./marks";

const STATUS_SIGNS = { running: "▶", paused: "❚❚", fault: "▲" } as const;
const STATUS_TONES = { running: "is-good", paused: "muted", fault: "is-bad" } as const;
const PHASE_SIGNS = {
  live: "●",
  slow: "◌",
  busy: "◌",
  connecting: "◌",
  lost: "○",
  blocked: "○",
  locked: "○",
  ended: "○",
} as const;

const wordOf = (bench: BenchState): string =>
  isStarting(bench) ? t("bench.starting") : t(`bench.status.${bench.status}`);

function SessionPill({ state: { status, bench } }: { state: SessionState }) {
  const isStandingBench = bench !== null && status === "paused";
  const word = bench === null ? t(`status.${status}`) : wordOf(bench);
  if (!isLive.value) {
    return (
      <span
        class="small strong nowrap tone is-warn pill"
        title={t("status.lastKnown", { state: word })}
      >
        <span aria-hidden="true">?</span>{" "}
        {phase.value === "ended" ? t("connection.ended") : t("status.unknown")}
      </span>
    );
  }
  return (
    <span class={`small strong nowrap tone pill ${STATUS_TONES[status]}`}>
      <span aria-hidden="true">{isStandingBench ? "○" : STATUS_SIGNS[status]}</span> {word}
    </span>
  );
}

interface CellProps {
  name: string;
  hint?: string;
  class?: string;
  children: ComponentChildren;
}

function Cell({ name, hint, children, ...rest }: CellProps) {
  return (
    <div class={`rigid small nowrap status-cell ${rest.class ?? ""}`} title={hint}>
      <dt>{name}</dt>
      <dd class="clip">{children}</dd>
    </div>
  );
}

function SimulatedLoop({ state }: { state: SessionState }) {
  const { status, rate_hz: rateHz, real_time_factor: factor, accumulated_delay_s: delay } = state;
  const moving =
    status === "running"
      ? t("status.realTime", { factor: formatNumber(factor, 3, 2) })
      : t("status.standing");
  const pace = phase.value === "live" ? moving : t("status.notKnown");
  return (
    <Cell
      name={t("status.loop")}
      class="is-loop"
      hint={t("status.rateHint", { delay: formatLapse(delay) })}
    >
      {t("status.rate", { hertz: Number(rateHz.toFixed(1)) })} <small>{pace}</small>
    </Cell>
  );
}

function BenchLoop({ bench: { loop } }: { bench: BenchState }) {
  if (!isLive.value) {
    return (
      <Cell name={t("status.loop")} class="is-loop is-bench">
        {t("status.rate", { hertz: Number(loop.rate_hz.toFixed(1)) })}{" "}
        <small>{t("status.notKnown")}</small>
      </Cell>
    );
  }
  if (!loop.alive) {
    const isBad = loop.state !== "starting";
    return (
      <Cell name={t("status.loop")} class={`is-loop ${isBad ? "bad" : ""}`}>
        <span aria-hidden="true">{isBad ? "▲" : "◌"}</span> {t(`bench.loop.states.${loop.state}`)}
      </Cell>
    );
  }
  const late = t("status.late", {
    median: formatLapse(loop.lateness_p50_s),
    most: formatLapse(loop.lateness_p99_s),
  });
  return (
    <Cell name={t("status.loop")} class="is-loop is-bench" hint={t("status.lateHint")}>
      {t("status.rate", { hertz: Number(loop.rate_hz.toFixed(1)) })}{" "}
      <small>
        {late} · {t("status.skipped", { count: loop.skipped_in_run })}
      </small>
    </Cell>
  );
}

function RecordingCell({ state: { recording, rate_hz: rateHz } }: { state: SessionState }) {
  const isOn = recording?.state === "recording";
  if (!isLive.value) {
    return (
      <Cell name={t("status.recording")} class="is-idle">
        {t("status.notKnown")}
      </Cell>
    );
  }
  return (
    <Cell name={t("status.recording")} class={isOn ? "bad" : "is-idle"}>
      {isOn && <span aria-hidden="true">●</span>}{" "}
      {isOn ? formatSeconds(recording.ticks / rateHz) : t("status.notRecording")}
    </Cell>
  );
}

function Connection() {
  const missed = missedSamples.value;
  return (
    <Cell name={t("status.connection")} class={phase.value === "live" ? "good" : "bad"}>
      <span role="status">
        <span aria-hidden="true">{PHASE_SIGNS[phase.value]}</span> {t(`connection.${phase.value}`)}
      </span>{" "}
      {missed > 0 && (
        <small title={t("connection.missedHint")}>
          {t("connection.missed", { count: missed })}
        </small>
      )}
    </Cell>
  );
}

/** Set the height of the bar as CSS variable, for elements above it. */
function usePublishedHeight() {
  const bar = useRef<HTMLElement>(null);
  useLayoutEffect(() => {
    const { current } = bar;
    if (current === null) return;
    const publish = () =>
      document.documentElement.style.setProperty("--statusbar", `${current.offsetHeight}px`);
    const watching = new ResizeObserver(publish);
    watching.observe(current, { box: "border-box" });
    return () => watching.disconnect();
  }, []);
  return bar;
}

/**
 * Always at the bottom of the window. State and quick stop of a simulated session appear only on
 * the lab page; those of a bench on every page. The key works on all pages.
 */
export function StatusBar() {
  const state = session.value;
  const bar = usePublishedHeight();
  const isShown = isLabShown(place.value) || state?.bench != null;
  const shown = isShown ? state : null;
  // While the plant is unknown, the button stays.
  const hasStop = isShown || state === null || !isLive.value;
  return (
    <section ref={bar} class="bar is-foot rigid statusbar" aria-label={t("status.heading")}>
      <div class="line status-now">
        <CornerMark />
        {shown && <SessionPill state={shown} />}
        {shown && <Clock />}
      </div>
      <dl class="line joined grow tabular status-cells">
        {shown &&
          (shown.bench ? <BenchLoop bench={shown.bench} /> : <SimulatedLoop state={shown} />)}
        {state && <RecordingCell state={state} />}
        <Connection />
        {state && <ControlCell />}
      </dl>
      {hasStop && <StopButton />}
    </section>
  );
}

const readTime = () => formatTime(samples.ring.newestTime || 0);

/** Session time of the newest sample. */
function Clock() {
  const element = useLiveText<HTMLSpanElement>(readTime);
  return (
    <span
      class="strong tabular clock"
      title={t("status.timeHint")}
      role="timer"
      aria-label={t("status.time")}
    >
      <span ref={element} />
    </span>
  );
}
