import { useSignalEffect } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { Swatch } from "../plots/legend";
import { palette } from "../plots/palette";
import { text } from "../text/en";
import { DifferenceTable } from "./differencetable";
import { MetricsTable } from "./metricstable";
import { CHANNELS, nameCurve, type Overlaid, type OverlayChannel, readOverlaid } from "./overlaid";
import { OverlayChart } from "./overlaychart";
import { PlaceLink } from "./placelink";
import { attempt } from "./problem";

const words = text.overlay;
const TITLES: Record<OverlayChannel, { title: string; unit: string }> = {
  position_error_rad: { title: words.error, unit: words.degrees },
  stiffness_error_nm_per_rad: { title: words.stiffness, unit: words.stiffnessUnit },
};

interface PlotProps {
  channel: OverlayChannel;
  curves: readonly Overlaid[];
  hidden: ReadonlySet<string>;
}

function OverlayPlot({ channel, curves, hidden }: PlotProps) {
  const host = useRef<HTMLDivElement>(null);
  const chart = useRef<OverlayChart | null>(null);
  const { title, unit } = TITLES[channel];
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    const made = new OverlayChart(element, curves, channel);
    chart.current = made;
    const observer = new ResizeObserver(() =>
      made.resize(element.clientWidth, element.clientHeight),
    );
    observer.observe(element);
    return () => {
      observer.disconnect();
      made.destroy();
      chart.current = null;
    };
  }, [curves, channel]);
  useEffect(() => {
    curves.forEach((curve, index) => {
      chart.current?.show(index, !hidden.has(curve.key));
    });
  }, [curves, hidden]);
  useSignalEffect(() => {
    void palette.value;
    chart.current?.redraw();
  });
  return (
    <section class="overlay-plot" aria-label={title}>
      <h3>
        {title} <span class="unit">{unit}</span>
      </h3>
      <div class="overlay-canvas" ref={host} title={words.hint} />
    </section>
  );
}

interface LegendProps {
  curves: readonly Overlaid[];
  hidden: ReadonlySet<string>;
  onToggle: (key: string) => void;
}

/** What time 0 is of a run whose numbers are of no load. */
const beginningOf = ({ window }: Overlaid): string =>
  window?.label ? words.fromChange(window.label) : words.fromStart;

function OverlayLegend({ curves, hidden, onToggle }: LegendProps) {
  return (
    <div class="overlay-legend">
      {curves.map((curve) => (
        <button
          key={curve.key}
          type="button"
          class="legend-entry"
          aria-pressed={!hidden.has(curve.key)}
          title={words.toggle(nameCurve(curve))}
          onClick={() => onToggle(curve.key)}
        >
          <Swatch look={curve.ink} />
          {nameCurve(curve)}
          {!curve.hasOnset && <small class="unit"> {beginningOf(curve)}</small>}
          {curve.changedS !== null && (
            <small class="unit"> {words.measured(curve.changedS.toFixed(2))}</small>
          )}
        </button>
      ))}
    </div>
  );
}

/** Runs over one another, from where the window of the numbers of each begins: its last load. */
export function OverlayPage({ runs }: { runs: readonly string[] }) {
  const [curves, setCurves] = useState<readonly Overlaid[] | null>(null);
  const [hidden, setHidden] = useState<ReadonlySet<string>>(new Set());
  const key = runs.join();
  useEffect(() => {
    let isGone = false;
    void attempt(() => readOverlaid(key.split(","))).then((read) => {
      if (!isGone) setCurves(read ?? []);
    });
    return () => {
      isGone = true;
    };
  }, [key]);
  const toggle = (curve: string) => {
    const next = new Set(hidden);
    if (!next.delete(curve)) next.add(curve);
    setHidden(next);
  };
  return (
    <>
      <div class="runs-head">
        <PlaceLink to={{ kind: "list" }} class="button">
          ← {text.run.toList}
        </PlaceLink>
        <h2>
          {words.title} <small class="unit">{words.aligned}</small>
        </h2>
      </div>
      {curves === null && <p class="runs-empty">{text.runs.loading}</p>}
      {curves?.length === 0 && <p class="runs-empty">{words.nothing}</p>}
      {curves && curves.length > 0 && (
        <div class="overlay">
          <OverlayLegend curves={curves} hidden={hidden} onToggle={toggle} />
          {CHANNELS.map((channel) => (
            <OverlayPlot key={channel} channel={channel} curves={curves} hidden={hidden} />
          ))}
          <MetricsTable curves={curves} />
          <DifferenceTable runs={key.split(",")} />
        </div>
      )}
    </>
  );
}
