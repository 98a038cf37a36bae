/** The list of plots, which shows whole plots only and scrolls to the others. */
import type { RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { Joint } from "../api/types";
import { shownJoints } from "../state/arm";
import { isLive } from "../state/session";
import { t } from "../text/t";
import { goTo, useBelow } from "../widgets/below";
import { CursorHandles, CursorLines } from "./cursorlines";
import { areCursorsOn, releaseCursors } from "./cursors";
import { EventMarks } from "./events";
import { followChannels, isZoomOn } from "./eventzoom";
import { listenToGestures } from "./gestures";
import { HoverLine } from "./hover";
import { MeasureTable } from "./measures";
import { Plot } from "./plot";
import { BASIC_SETUPS, type PlotSetup, setups } from "./setups";
import { followSession, isFrozen } from "./span";
import { TimeAxis, ZoomAxis, ZoomTitle } from "./timeaxis";
import { Toolbar } from "./toolbar";

/** Height of the events above the plots, and of the time axis below them. */
const TOP_PX = 22;
const FOOT_PX = 24;
/** Height of a plot's title and legend, if the legend has one row. */
const HEAD_PX = 26;

/** Overlap of the last plot and the time axis, which hides the edge of the next plot. */
const UNDER_PX = 1;

/**
 * Height of a plot including its header, px: as many plots as fit share the list, each at least
 * this high. head: header height of the plot with the longest legend, px.
 */
export function shareOfList(height: number, leastPicture: number, head = HEAD_PX): number {
  const room = height - TOP_PX - FOOT_PX;
  const together = Math.max(1, Math.floor(room / (leastPicture + Math.max(HEAD_PX, head))));
  return Math.max(0, (room + UNDER_PX) / together);
}

/** Update `--plot-share` of a list with these plots; returns the function that stops it. */
function keepShare(list: HTMLElement): () => void {
  const heads = [...list.querySelectorAll(".plots-stage > .plot > .plot-head")];
  const measure = () => {
    const least = Number.parseFloat(getComputedStyle(list).getPropertyValue("--least-plot"));
    const head = Math.max(0, ...heads.map((element) => element.getBoundingClientRect().height));
    list.style.setProperty("--plot-share", `${shareOfList(list.clientHeight, least, head)}px`);
  };
  const resizing = new ResizeObserver(measure);
  for (const element of [list, ...heads]) resizing.observe(element);
  return () => resizing.disconnect();
}

/** Number of plots that are scrolled out of view below; a click scrolls to the first of them. */
function PlotsBelow({ list }: { list: RefObject<HTMLElement | null> }) {
  const below = useBelow(list, ".plot", FOOT_PX);
  const [first] = below;
  if (first === undefined) return null;
  return (
    <button
      type="button"
      class="quiet strong plots-below"
      title={t("plots.below", { count: below.length })}
      aria-label={t("plots.below", { count: below.length })}
      onClick={() => goTo(first)}
    >
      ↓ {below.length}
    </button>
  );
}

/** A plot of a setup for each joint of an arm; one for a single joint. */
function PlotPerJoint({ setup, isBasic }: { setup: PlotSetup; isBasic: boolean }) {
  const joints: readonly (Joint | null)[] = shownJoints.value ?? [null];
  return (
    <>
      {joints.map((joint) => (
        <Plot key={joint ?? 0} setup={setup} isBasic={isBasic} joint={joint} />
      ))}
    </>
  );
}

interface StageProps {
  list: RefObject<HTMLElement | null>;
  shown: readonly PlotSetup[];
  isBasic: boolean;
}

/** The plots over time between the events and the axis, and everything drawn across all of them. */
function Stage({ list, shown, isBasic }: StageProps) {
  const stage = useRef<HTMLDivElement>(null);
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (stage.current === null || box.current === null) return;
    return listenToGestures(stage.current, box.current);
  }, []);
  const overTime = shown.filter(({ preset }) => preset !== "phase");
  return (
    <div class="plots-stage" ref={stage}>
      <div class="plots-top">
        <EventMarks />
        {isZoomOn.value && <ZoomTitle />}
      </div>
      {overTime.map((setup) => (
        <PlotPerJoint key={setup.key} setup={setup} isBasic={isBasic} />
      ))}
      <div class="plots-box" ref={box}>
        <HoverLine />
        <CursorLines box={box} />
      </div>
      <div class="plots-foot">
        <PlotsBelow list={list} />
        <div class="plots-foot-box">
          <TimeAxis />
          <CursorHandles box={box} />
        </div>
        {isZoomOn.value && <ZoomAxis />}
      </div>
    </div>
  );
}

/** All plots, synchronised; two in the basic view. */
export function Plots({ isBasic }: { isBasic: boolean }) {
  const list = useRef<HTMLElement>(null);
  useEffect(() => {
    const ends = [followSession(), followChannels(), releaseCursors()];
    return () => {
      for (const end of ends) end();
    };
  }, []);
  const shown = isBasic ? BASIC_SETUPS : setups.value;
  useEffect(
    () => (list.current === null ? undefined : keepShare(list.current)),
    [shown, shownJoints.value],
  );
  const phase = shown.find(({ preset }) => preset === "phase");
  const isEmpty = shown.length === 0;
  const looks = {
    "is-frozen": !isLive.value && !isFrozen.value,
    "is-measured": areCursorsOn.value,
    "is-zoomed": isZoomOn.value,
  };
  const look = Object.entries(looks).flatMap(([name, isOn]) => (isOn ? [name] : []));
  return (
    <section
      class={["surface", "plots", ...look].join(" ")}
      aria-label={t("plots.heading")}
      id="plots"
      tabIndex={-1}
    >
      <h2 class="visually-hidden">{t("plots.heading")}</h2>
      <Toolbar isBasic={isBasic} />
      <section
        key={isBasic ? "basic" : "all"}
        class="column joined scroller plots-scroll"
        ref={list}
        aria-label={t("plots.list")}
        // biome-ignore lint/a11y/noNoninteractiveTabindex: scrolling needs the keyboard
        tabIndex={0}
      >
        {isEmpty ? (
          <p class="empty">{t("plots.none")}</p>
        ) : (
          <Stage list={list} shown={shown} isBasic={isBasic} />
        )}
        {phase && <PlotPerJoint key={phase.key} setup={phase} isBasic={isBasic} />}
      </section>
      <MeasureTable />
    </section>
  );
}
