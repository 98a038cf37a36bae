import { computed } from "@preact/signals";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Joint } from "../api/types";
import { EquationButton } from "../equations/equation";
import { limitRate } from "../rate";
import { jointCount } from "../state/arm";
import type { LaneSegments } from "../state/lanes";
import { lawOf } from "../state/laws";
import { bench } from "../state/plant";
import { session } from "../state/session";
import type { SampleRing } from "../stream/ring";
import { t } from "../text/t";
import { formatNumber } from "../units";
import { CHANNELS, spanOf, unitOf } from "./channels";
import { Chart } from "./chart";
import { ChartBox } from "./chartbox";
import { isWithin, ownerOf, readPiece, type Trace } from "./definitions";
import { describeEstimate, ESTIMATE } from "./estimate";
import { EVENT_VIEW, isZoomOn, zoomedLaneSegments } from "./eventzoom";
import { onFrame } from "./frame";
import { hoverShare, sampleRead } from "./hover";
import { composeOfJoint, lanesOfJoint } from "./joints";
import { Legend, useHidden } from "./legend";
import { PlotMenu } from "./menu";
import { type PhaseChannels, PhaseChart } from "./phase";
import { type PlotSetup, withoutMissing } from "./setups";
import { PLOTS_VIEW, shownLaneSegments, shownRing, shownSpan } from "./span";
import { hasOneValue, hasUnnamedTruth, noteOfStiffness, tracesOf } from "./traces";

const READING_MS = 120;

export function titleOf({ preset, channels }: PlotSetup): string {
  if (preset !== "own") return t(`plots.presets.${preset}`);
  const [first] = channels;
  return first === undefined
    ? ""
    : channels.length - 1 > 0
      ? t("plots.own", { first: t(`channelNames.${first}`), more: channels.length - 1 })
      : t(`channelNames.${first}`);
}

function makeChart(host: HTMLElement, { preset, channels }: PlotSetup, traces: readonly Trace[]) {
  if (preset !== "phase") return new Chart(host, traces, spanOf(channels), PLOTS_VIEW);
  return new PhaseChart(host, traces, channels as PhaseChannels);
}

const makeZoom = (host: HTMLElement, { channels }: PlotSetup, traces: readonly Trace[]) =>
  new Chart(host, traces, spanOf(channels), EVENT_VIEW);

/** The curves of a plot, as the user has selected them. */
function useTraces(
  { preset, channels }: PlotSetup,
  chosen: ReadonlySet<string>,
  lanes: LaneSegments,
  joint: Joint | null,
) {
  const drawn = preset === "phase" ? channels.slice(1) : withoutMissing(channels);
  const key = drawn.join();
  const content = useMemo(
    () => composeOfJoint(drawn, lanes, joint, jointCount.value, bench.value !== null),
    [key, lanes, joint],
  );
  const groupKeys = content.groups.map((group) => group.key);
  const valid = groupKeys.filter((group) => chosen.has(group));
  const shown = new Set(valid.length > 0 ? valid : groupKeys.slice(0, 1));
  const shownKey = [...shown].join();
  const count = lanesOfJoint(lanes.length, joint, jointCount.value).length;
  const traces = useMemo(() => tracesOf(content, shown, count), [content, shownKey]);
  return { content, shown, traces, isSideBySide: count > 1 };
}

/**
 * Write the values under the pointer, or the newest, into the legend; hide controllers that left
 * the span.
 */
function keepReadings(traces: readonly Trace[], readings: ReadonlyMap<string, HTMLElement>) {
  const read = () => {
    const ring = shownRing();
    const index = sampleRead();
    const { from } = shownSpan();
    for (const [key, element] of readings) {
      const values = traces.filter((trace) => ownerOf(trace) === key);
      const entry = element.parentElement as HTMLElement;
      const isGone = values.every(({ to }) => to <= from);
      const isEstimate = values.some(({ channel }) => channel === ESTIMATE);
      const next = isEstimate
        ? readEstimate(ring, values, index)
        : formatNumber(
            values.map((trace) => readPiece(ring, trace, index)).find(Number.isFinite),
            3,
            3,
          );
      entry.hidden = isGone || next === null;
      if (isEstimate) {
        element.title = next ?? "";
        element.classList.toggle("is-text", !next?.includes("±"));
      }
      if (element.textContent !== next) element.textContent = next;
    }
  };
  const { request, cancel } = limitRate(read, () => READING_MS);
  const stopFrames = onFrame(request);
  const stopHover = hoverShare.subscribe(read);
  return () => {
    cancel();
    stopFrames();
    stopHover();
  };
}

/** The estimate of a sample; null if the ring has none at all. */
function readEstimate(ring: SampleRing, values: readonly Trace[], index: number): string | null {
  const piece = values.find((trace) => isWithin(trace, ring.timeAt(index)));
  const text = piece ? describeEstimate((name) => ring.valueAt(name, index, piece.lane)) : "";
  const isIn = ({ lane }: Trace) => !Number.isNaN(ring.firstTimeOf(ESTIMATE, lane));
  return text !== "" || values.some(isIn) ? text : null;
}

interface ChooserProps {
  title: string;
  groups: readonly { key: string; label: string }[];
  shown: ReadonlySet<string>;
  onChoose: (keys: ReadonlySet<string>) => void;
}

/** Selection of the quantities if several lanes have several; at least one. */
function Chooser({ title, groups, shown, onChoose }: ChooserProps) {
  const toggle = (key: string) => {
    const next = new Set(shown);
    if (!next.delete(key)) next.add(key);
    if (next.size > 0) onChoose(next);
  };
  return (
    <fieldset class="choices" aria-label={t("plots.choose", { title })}>
      {groups.map(({ key, label }) => (
        <label key={key} class="chip">
          <input type="checkbox" checked={shown.has(key)} onChange={() => toggle(key)} />
          <span>{label}</span>
        </label>
      ))}
    </fieldset>
  );
}

interface PlotProps {
  setup: PlotSetup;
  /** Leaves out its equation and its menu. */
  isBasic: boolean;
  /** Of an arm; null for a single joint. */
  joint?: Joint | null;
}

export function Plot({ setup, isBasic, joint = null }: PlotProps) {
  const [chosen, setChosen] = useState<ReadonlySet<string>>(new Set());
  const [hidden, toggle] = useHidden();
  const { content, shown, traces, isSideBySide } = useTraces(
    setup,
    chosen,
    shownLaneSegments.value,
    joint,
  );
  const isPhase = setup.preset === "phase";
  const isZoomed = isZoomOn.value && !isPhase;
  const zoomed = useTraces(
    setup,
    chosen,
    isZoomed ? zoomedLaneSegments() : shownLaneSegments.value,
    joint,
  ).traces;
  const readings = useRef(new Map<string, HTMLElement>()).current;
  useEffect(() => keepReadings(traces, readings), [traces]);
  const title =
    joint === null ? titleOf(setup) : t("plots.ofJoint", { joint, title: titleOf(setup) });
  return (
    <section
      class={`plot ${isPhase ? "is-phase" : ""}`}
      aria-label={t("plots.plotOf", { title })}
      data-plot={joint === null ? setup.key : `${setup.key}.${joint}`}
    >
      <div class="plot-head">
        <h3 tabIndex={-1}>
          {title}{" "}
          <span class="unit">{unitOf(isPhase ? setup.channels.slice(1) : setup.channels)}</span>
        </h3>
        {setup.preset !== "own" && !isBasic && <EquationButton topic={setup.preset} />}
        {isSideBySide && content.groups.length > 1 && (
          <Chooser title={title} groups={content.groups} shown={shown} onChoose={setChosen} />
        )}
        <Legend
          note={noteOf(setup, traces)}
          entries={traces.filter((trace) => trace.follows === undefined)}
          hidden={hidden.value}
          readings={readings}
          isRead={(key) => hasOneValue(traces, key)}
          onToggle={toggle}
        />
        {!isBasic && <PlotMenu setup={setup} title={title} traces={traces} hidden={hidden.value} />}
      </div>
      <div class="plot-row">
        <ChartBox class="plot-canvas" make={makeChart} {...{ setup, traces, hidden }} />
        {isZoomed && (
          <ChartBox class="plot-zoom" make={makeZoom} {...{ setup, traces: zoomed, hidden }} />
        )}
      </div>
    </section>
  );
}

/** The laws that use no estimate. */
const lawsWithout = computed(() => {
  const laws = (session.value?.lanes ?? []).map(({ law }) => lawOf(law));
  return [...new Set(laws.flatMap((law) => (law?.estimate === "none" ? [law.title] : [])))].join(
    ", ",
  );
});

function noteOf({ preset, channels }: PlotSetup, traces: readonly Trace[]): string | undefined {
  const [across] = channels;
  if (preset === "phase" && across !== undefined) {
    return t("plots.phaseNote", {
      across: t(`channelNames.${across}`),
      unit: CHANNELS[across].unit,
    });
  }
  const isUnused = lawsWithout.value && channels.some((channel) => channel.startsWith("estimate_"));
  const unused = isUnused ? [t("plots.unusedEstimate", { law: lawsWithout.value })] : [];
  const truth = hasUnnamedTruth(traces) ? [t("plots.disturbanceNote")] : [];
  return (
    [noteOfStiffness(traces, bench.value !== null) ?? [], unused, truth].flat().join(" · ") ||
    undefined
  );
}
