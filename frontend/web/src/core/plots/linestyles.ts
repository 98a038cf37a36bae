/**
 * Stable line styles: each law has its own color, each controller a number from the server, the
 * same in every picture; several channels of one lane have different colors. Only references are
 * dotted.
 */

import { computed } from "@preact/signals";
import type { Law } from "../api/types";
import { lawOf } from "../state/laws";
import { theme } from "../state/preferences";
import type { LineStyle, PlotColour } from "./definitions";

export const PLAIN: readonly number[] = [];
export const DASHED: readonly number[] = [6, 5];
export const DOTTED: readonly number[] = [2, 4];

const LANE_COLOURS: readonly PlotColour[] = ["blue", "vermilion", "green", "purple", "orange"];
const COMPARISON_DASHES = [
  [5, 3],
  [9, 4],
  [14, 4, 5, 4],
] as const;
const LANE_DASHES = [PLAIN, ...COMPARISON_DASHES] as const;
/** From the twenty-first law on. */
const FURTHER_DASHES = [
  [14, 4, 5, 4, 5, 4],
  [4, 3, 9, 3],
] as const;

function chooseDash(lineStyle: number): readonly number[] {
  const isFurther = lineStyle >= LANE_COLOURS.length * LANE_DASHES.length;
  const dashes = isFurther ? FURTHER_DASHES : LANE_DASHES;
  return dashes[lineStyle % dashes.length] as readonly number[];
}

/**
 * Line style 0, 1, …: thirty, no two with the same color and dash, neighbours with different color
 * and dash.
 */
export const lineStyleOf = (lineStyle: number): LineStyle => ({
  colour: LANE_COLOURS[lineStyle % LANE_COLOURS.length] as PlotColour,
  dash: chooseDash(lineStyle),
  width: 2,
});

/**
 * The current controller of lane 1 is selected: its curve is solid and wide, those of others are
 * dashed.
 */
export const lineStyleOfLane = (lineStyle: number, isChosen: boolean): LineStyle => {
  const dash = COMPARISON_DASHES[lineStyle % COMPARISON_DASHES.length] as readonly number[];
  const look = isChosen ? { dash: PLAIN, width: 2.5 } : { dash };
  return { ...lineStyleOf(lineStyle), ...look };
};

/**
 * A line style for each of several curves: its own if the color is free, otherwise the first with a
 * free color; if none is free, one with another dash. The order matters only for curves with the
 * same own line style: next to other laws, these keep their color and differ in dash. null: a curve
 * without its own style.
 */
export function shareLineStyles(own: readonly (number | null)[]): LineStyle[] {
  const shared = new Map<number, number>();
  const isTaken = (lineStyle: number) => [...shared.values()].includes(lineStyle);
  const isColourTaken = (lineStyle: number) =>
    [...shared.values()].some((usedStyle) => (usedStyle - lineStyle) % LANE_COLOURS.length === 0);
  const firstLook = () => {
    let lineStyle = 0;
    while (isTaken(lineStyle)) lineStyle++;
    return lineStyle;
  };
  const preferredColours = own
    .map((lineStyle, index) => ({ lineStyle: lineStyle ?? Number.MAX_SAFE_INTEGER, index }))
    .sort((first, second) => first.lineStyle - second.lineStyle);
  const areOfOneLaw = new Set(own).size === 1;
  const listLooks = (lineStyle: number) =>
    LANE_DASHES.map((_, turn) => lineStyle + turn * LANE_COLOURS.length);
  for (const { lineStyle, index } of preferredColours) {
    if (own[index] === null) continue;
    const isAgain = preferredColours.some(
      (preferred) => preferred.lineStyle === lineStyle && shared.has(preferred.index),
    );
    const look =
      isAgain && !areOfOneLaw
        ? listLooks(lineStyle).find((candidate) => !isTaken(candidate))
        : undefined;
    if (look !== undefined) shared.set(index, look);
    else if (!isColourTaken(lineStyle)) shared.set(index, lineStyle);
  }
  for (const { index } of preferredColours) {
    if (shared.has(index)) continue;
    const free = [...LANE_COLOURS.keys()].find((lineStyle) => !isColourTaken(lineStyle));
    shared.set(index, free ?? firstLook());
  }
  return own.map((_, index) => lineStyleOf(shared.get(index) as number));
}

/** The controller of a lane at a time; null if unknown. */
export const lineStyleAt = (
  segments: readonly { line_style: number; start_s: number }[] | undefined,
  timeS: number,
): number | null =>
  segments?.filter(({ start_s: start }) => start <= timeS).at(-1)?.line_style ?? null;

/**
 * A color for each request in turn: the requested one, or the next free one; when all are used they
 * repeat, dashed.
 */
export function shareColours(
  preferredColours: readonly PlotColour[],
): Pick<LineStyle, "colour" | "dash">[] {
  const used: PlotColour[] = [];
  return preferredColours.map((preferred) => {
    const round = Math.floor(used.length / LANE_COLOURS.length);
    const taken = used.slice(round * LANE_COLOURS.length);
    const free = LANE_COLOURS.filter((colour) => !taken.includes(colour));
    const colour = free.includes(preferred) ? preferred : (free[0] as PlotColour);
    used.push(colour);
    return { colour, dash: round === 0 ? PLAIN : [9, 4] };
  });
}

// The colors of theme.css for the canvas, read again when the theme changes.

export interface Palette extends Record<PlotColour, string> {
  axis: string;
  grid: string;
  mark: string;
  surface: string;
}

export const palette = computed<Palette>(() => {
  void theme.value;
  const style = getComputedStyle(document.documentElement);
  const read = (name: string) => style.getPropertyValue(`--plot-${name}`).trim();
  return {
    reference: read("reference"),
    blue: read("blue"),
    orange: read("orange"),
    green: read("green"),
    vermilion: read("vermilion"),
    purple: read("purple"),
    axis: read("axis"),
    grid: read("grid"),
    mark: read("mark"),
    surface: style.getPropertyValue("--surface").trim(),
  };
});

// Line styles of laws: the same as in the lab, so that a law looks the same on every page.

/** Styles of laws in one picture, which differ in color as long as there are enough colors. */
export const lineStylesOfLaws = (names: readonly Law[]): LineStyle[] =>
  shareLineStyles(names.map((name) => lawOf(name)?.line_style ?? null));

/** Color for the background of a dot; undefined for a law that is not in the picture. */
export const dotOf = (lineStyle: LineStyle | undefined) =>
  lineStyle && { background: `var(--plot-${lineStyle.colour})` };
