import type { ReadonlySignal } from "@preact/signals";
import { useEffect, useMemo, useState } from "preact/hooks";
import uPlot from "uplot";
import { readDifference } from "../../core/api/runs";
import type { RunDifference } from "../../core/api/types";
import { Legend, useHidden } from "../../core/plots/legend";
import {
  describeTimeChart,
  spanWithin,
  useStaticChart,
  wholeOf,
} from "../../core/plots/staticchart";
import { t } from "../../core/text/t";
import { formatFixed } from "../../core/units";
import { DifferenceTable } from "./differencetable";
import { drawBands, drawEdges, drawOutside, drawWorst } from "./drawnverdict";
import {
  CHANNELS,
  nameCurve,
  nameWindow,
  type OverlayChannel,
  type OverlayCurve,
  readCurves,
  TITLES,
} from "./overlaycurves";
import { OverlayTable } from "./overlaytable";
import { PlaceLink } from "./place";
import { attempt } from "./problem";
import { listAssessments, listBands, type RunAssessment } from "./verdict";
import { VerdictPanel } from "./verdictpanel";

const MIN_SPANS: Record<OverlayChannel, number> = {
  position_error_rad: 0.004,
  stiffness_error_nm_per_rad: 0.001,
};
const TIME_AXIS_PX = 26;

interface PlotProps {
  channel: OverlayChannel;
  curves: readonly OverlayCurve[];
  judged: readonly RunAssessment[];
  view: ReturnType<typeof spanWithin>;
  hidden: ReadonlySignal<ReadonlySet<string>>;
}

function describeChart({ channel, curves, judged, view, hidden }: PlotProps) {
  const bands = listBands(curves, judged, channel);
  const listShown = (plot: uPlot) =>
    listAssessments(curves, judged).filter(
      (assessment) =>
        assessment.channel === channel &&
        plot.series[curves.indexOf(assessment.curve) + 1]?.show === true,
    );
  const tables = curves.map(
    (curve): uPlot.AlignedData => [Array.from(curve.time), curve.values[channel]],
  );
  const [time, ...values] = uPlot.join(tables);
  return describeTimeChart({
    time,
    curves: curves.map(({ key, lineStyle }, index) => ({
      key,
      ...lineStyle,
      values: values[index] ?? [],
    })),
    minSpan: MIN_SPANS[channel],
    padding: [8, 14, 0, 0],
    timeAxis: {
      size: TIME_AXIS_PX,
      tick: (seconds: number) =>
        t("overlay.timeTick", { seconds: Number(seconds.toFixed(4)) }).replace("-", "−"),
    },
    group: "overlay",
    hidden,
    ...view,
    drawBelow: (plot) => {
      drawBands(plot, bands);
      drawOutside(plot, listShown(plot));
      drawEdges(plot, curves);
    },
    drawAbove: (plot) => drawWorst(plot, listShown(plot)),
  });
}

function OverlayPlot(props: PlotProps) {
  const { channel, curves, judged, view } = props;
  const { title, unit } = TITLES[channel];
  const host = useStaticChart(useMemo(() => describeChart(props), [channel, curves, judged, view]));
  return (
    <section class="column joined overlay-plot" aria-label={title}>
      <h3 class="small">
        {title} <span class="unit">{unit}</span>
      </h3>
      <div class="grow overlay-canvas" ref={host} title={t("overlay.hint")} />
    </section>
  );
}

const isMeasuredInPart = ({ startS, changedS }: OverlayCurve): boolean =>
  startS !== 0 || changedS !== null;

const measuredOf = ({ startS, changedS, time }: OverlayCurve): string =>
  t("overlay.measured", {
    from: formatFixed(startS, 2),
    to: formatFixed(changedS ?? time.at(-1) ?? 0, 2),
  });

function Remark({ curve }: { curve: OverlayCurve }) {
  return (
    <>
      {!curve.startsWithLoad && <small class="unit"> {nameWindow(curve)}</small>}
      {isMeasuredInPart(curve) && <small class="unit"> {measuredOf(curve)}</small>}
    </>
  );
}

function OverlayCurves({ curves, judged }: Pick<PlotProps, "curves" | "judged">) {
  const [hidden, toggle] = useHidden();
  const view = useMemo(() => spanWithin(wholeOf(curves.map(({ time }) => time))), [curves]);
  return (
    <>
      <Legend
        class="row small"
        entries={curves.map((curve) => ({
          key: curve.key,
          ...curve.lineStyle,
          label: nameCurve(curve),
          remark: <Remark curve={curve} />,
        }))}
        hidden={hidden.value}
        onToggle={toggle}
      />
      {CHANNELS.map((channel) => (
        <OverlayPlot key={channel} {...{ channel, curves, judged, view, hidden }} />
      ))}
    </>
  );
}

/** Overlaid runs; `chooseAlignment` selects where each starts. */
export function OverlayPage({ runs }: { runs: readonly string[] }) {
  const [curves, setCurves] = useState<readonly OverlayCurve[] | null>(null);
  const [difference, setDifference] = useState<RunDifference | null>(null);
  const [judged, setJudged] = useState<readonly RunAssessment[]>([]);
  const key = runs.join();
  useEffect(() => {
    let isGone = false;
    const [run, ...others] = key.split(",") as [string, ...string[]];
    void attempt(() => readCurves([run, ...others])).then((read) => {
      if (!isGone) setCurves(read ?? []);
    });
    setDifference(null);
    setJudged([]);
    if (others.length > 0) {
      void attempt(() => readDifference(run, others)).then((answer) => {
        if (!isGone) setDifference(answer);
      });
    }
    return () => {
      isGone = true;
    };
  }, [key]);
  return (
    <>
      <div class="row">
        <PlaceLink to={{ kind: "list" }} class="button">
          ← {t("run.toList")}
        </PlaceLink>
        <h2>
          {t("overlay.title")}{" "}
          <small class="unit">{t(`overlay.aligned.${curves?.[0]?.alignment ?? "window"}`)}</small>
        </h2>
      </div>
      {curves === null && <p class="empty">{t("runs.loading")}</p>}
      {curves?.length === 0 && <p class="empty">{t("overlay.nothing")}</p>}
      {curves && curves.length > 0 && (
        <div class="surface card column tight grow overlay">
          <OverlayCurves curves={curves} judged={judged} />
          {runs.length > 1 && (
            <VerdictPanel key={key} curves={curves} judged={judged} onJudged={setJudged} />
          )}
          <OverlayTable curves={curves} difference={difference} />
          {difference && <DifferenceTable difference={difference} />}
        </div>
      )}
    </>
  );
}
