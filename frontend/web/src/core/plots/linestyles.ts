/**
 * Stable line styles: a law has a colour of its own, a controller a number from the server, in every
 * picture; several channels of one lane have a colour each. Only references are dotted.
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

/** Line style 0, 1, …: twenty, of which no two share both colour and dash, and neighbours share neither. */
export const lineStyleOf = (lineStyle: number): LineStyle => ({
  colour: LANE_COLOURS[lineStyle % LANE_COLOURS.length] as PlotColour,
  dash: LANE_DASHES[lineStyle % LANE_DASHES.length] as readonly number[],
  width: 2,
});

/** The present controller of lane 1 is chosen: its curve is solid and wide, those of others are dashed. */
export const lineStyleOfLane = (lineStyle: number, isChosen: boolean): LineStyle => {
  const dash = COMPARISON_DASHES[lineStyle % COMPARISON_DASHES.length] as readonly number[];
  const look = isChosen ? { dash: PLAIN, width: 2.5 } : { dash };
  return { ...lineStyleOf(lineStyle), ...look };
};

/**
 * A line style for each of several curves: the own one where its colour is free, else the first whose
 * colour is; where none is, one that looks otherwise. The order decides only between curves whose own
 * line style is the same: next to other laws, these keep their colour and differ in dash. null: one
 * that has none.
 */
export function shareLineStyles(own: readonly (number | null)[]): LineStyle[] {
  const shared = new Map<number, number>();
  const isTaken = (lineStyle: number) => [...shared.values()].includes(lineStyle);
  const isColourTaken = (lineStyle: number) =>
    [...shared.values()].some((one) => (one - lineStyle) % LANE_COLOURS.length === 0);
  const firstLook = () => {
    let lineStyle = 0;
    while (isTaken(lineStyle)) lineStyle++;
    return lineStyle;
  };
  const wishes = own
    .map((lineStyle, index) => ({ lineStyle: lineStyle ?? Number.MAX_SAFE_INTEGER, index }))
    .sort((one, other) => one.lineStyle - other.lineStyle);
  const areOfOneLaw = new Set(own).size === 1;
  const listLooks = (lineStyle: number) =>
    LANE_DASHES.map((_, turn) => lineStyle + turn * LANE_COLOURS.length);
  for (const { lineStyle, index } of wishes) {
    if (own[index] === null) continue;
    const isAgain = wishes.some((one) => one.lineStyle === lineStyle && shared.has(one.index));
    const look =
      isAgain && !areOfOneLaw ? listLooks(lineStyle).find((one) => !isTaken(one)) : undefined;
    if (look !== undefined) shared.set(index, look);
    else if (!isColourTaken(lineStyle)) shared.set(index, lineStyle);
  }
  for (const { index } of wishes) {
    if (shared.has(index)) continue;
    const free = [...LANE_COLOURS.keys()].find((lineStyle) => !isColourTaken(lineStyle));
    shared.set(index, free ?? firstLook());
  }
  return own.map((_, index) => lineStyleOf(shared.get(index) as number));
}

/** Of the controller of a lane at a time; null if unknown. */
export const lineStyleAt = (
  segments: readonly { line_style: number; start_s: number }[] | undefined,
  timeS: number,
): number | null =>
  segments?.filter(({ start_s: start }) => start <= timeS).at(-1)?.line_style ?? null;

const COLOURS: readonly PlotColour[] = ["blue", "vermilion", "green", "orange", "purple"];

/**
 * A colour for each wish in turn: the one wished for, or the next that is free; once all are in use
 * they come again, dashed.
 */
export function shareColours(wishes: readonly PlotColour[]): Pick<LineStyle, "colour" | "dash">[] {
  const used: PlotColour[] = [];
  return wishes.map((wish) => {
    const round = Math.floor(used.length / COLOURS.length);
    const taken = used.slice(round * COLOURS.length);
    const free = COLOURS.filter((colour) => !taken.includes(colour));
    const colour = free.includes(wish) ? wish : (free[0] as PlotColour);
    used.push(colour);
    return { colour, dash: round === 0 ? PLAIN : [9, 4] };
  });
}

// The colours of theme.css as the canvas needs them, read again when the theme changes.

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

// The line styles of laws: each its own, as in the lab, so that a law looks the same on every page.

/** Of laws in one picture, which differ in colour while there are no more of them than colours. */
export const lineStylesOfLaws = (names: readonly Law[]): LineStyle[] =>
  shareLineStyles(names.map((name) => lawOf(name)?.line_style ?? null));

/** As the background of a dot; undefined for a law that is not in the picture. */
export const dotOf = (lineStyle: LineStyle | undefined) =>
  lineStyle && { background: `var(--plot-${lineStyle.colour})` };
