/** Files of the plotted data. */
import { session } from "../state/session";
import { t } from "../text/t";
import { includeBounds, niceRange } from "./axes";
import { boundsOf, CHANNELS, type ChannelName, spanOf, unitOf } from "./channels";
import { columnsOf, writeCsv } from "./csv";
import { Curve } from "./curves";
import { emptyPoints, extentOf } from "./decimation";
import type { Trace } from "./definitions";
import { palette } from "./linestyles";
import { type PhaseChannels, takePhase } from "./phase";
import { type PlotSetup, setups, withoutMissing } from "./setups";
import { shownLaneSegments, shownRing, shownSpan } from "./span";
import { type Drawing, drawSvg, HEIGHT, WIDTH } from "./svg";

const SHARPNESS = 2;

function fileName(what: string, ending: string): string {
  const { from, to } = shownSpan();
  const word = what.toLowerCase().replace(/[^a-z0-9]+/g, "-");
  return `${t("save.file", { what: word, from: from.toFixed(2), to: to.toFixed(2) })}.${ending}`;
}

function download(content: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

function drawTimePlot(title: string, { channels }: PlotSetup, traces: readonly Trace[]): Drawing {
  const { from, to } = shownSpan();
  const curves = traces.map((trace) => new Curve(trace));
  for (const curve of curves) curve.fill(shownRing(), { from, to }, WIDTH);
  const bounds = boundsOf(traces, session.peek());
  const extent = extentOf(curves.map(({ points }) => points));
  const [low, high] = niceRange(...extent, spanOf(channels));
  const [bottom, top] = includeBounds(
    low,
    high,
    bounds.map(({ value }) => value),
  );
  const events = session.peek()?.events ?? [];
  return {
    title,
    x: { label: t("save.axis", { label: t("save.time"), unit: "s" }), from, to },
    y: { label: t("save.axis", { label: title, unit: unitOf(channels) }), from: bottom, to: top },
    curves,
    bounds,
    events: events.map(({ time_s, label }) => ({ time: time_s, label })),
    colours: palette.peek(),
  };
}

function drawPhasePlane(title: string, setup: PlotSetup, traces: readonly Trace[]): Drawing {
  const channels = setup.channels as PhaseChannels;
  const curves = traces.map((trace) => ({ trace, points: emptyPoints() }));
  const { x, y } = takePhase(curves, channels);
  const axis = (name: ChannelName, [from, to]: [number, number]) => ({
    label: t("save.axis", { label: t(`channelNames.${name}`), unit: CHANNELS[name].unit }),
    from,
    to,
  });
  return {
    title,
    x: axis(channels[0], x),
    y: axis(channels[1], y),
    curves,
    bounds: [],
    events: [],
    colours: palette.peek(),
  };
}

function drawPlot(title: string, setup: PlotSetup, traces: readonly Trace[]): string {
  const draw = setup.preset === "phase" ? drawPhasePlane : drawTimePlot;
  return drawSvg(draw(title, setup, traces));
}

export function saveSvg(title: string, setup: PlotSetup, traces: readonly Trace[]): void {
  const drawing = drawPlot(title, setup, traces);
  download(new Blob([drawing], { type: "image/svg+xml" }), fileName(title, "svg"));
}

export async function savePng(
  title: string,
  setup: PlotSetup,
  traces: readonly Trace[],
): Promise<void> {
  const name = fileName(title, "png");
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(drawPlot(title, setup, traces))}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = WIDTH * SHARPNESS;
  canvas.height = HEIGHT * SHARPNESS;
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  canvas.toBlob((content) => content && download(content, name), "image/png");
}

/** Every controller of the channels, at the full rate of the stream. */
function saveCsv(what: string, channels: readonly ChannelName[]): void {
  const span = shownSpan();
  const csv = writeCsv(shownRing(), span, columnsOf(channels, shownLaneSegments.peek(), span));
  download(new Blob([csv], { type: "text/csv" }), fileName(what, "csv"));
}

export const savePlotCsv = (title: string, { channels }: PlotSetup): void =>
  saveCsv(title, withoutMissing(channels));

export function saveWindowCsv(): void {
  saveCsv(t("save.window"), [
    ...new Set(setups.peek().flatMap((setup) => withoutMissing(setup.channels))),
  ]);
}
