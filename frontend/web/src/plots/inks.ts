/** Stable inks: a lane's place in the session is its colour and dash; alone, a channel has its own. */
import type { Ink, PlotColour } from "./definitions";

export const PLAIN: readonly number[] = [];
export const DASHED: readonly number[] = [6, 5];
export const DOTTED: readonly number[] = [2, 4];

export const LANE_INKS: readonly Ink[] = [
  { colour: "blue", dash: PLAIN, width: 2.5 },
  { colour: "vermilion", dash: [9, 4], width: 2 },
  { colour: "green", dash: [3, 3], width: 2 },
  { colour: "purple", dash: [10, 3, 2, 3], width: 2 },
];

/** The ink of lane 1, 2, … */
export const inkOf = (lane: number): Ink => LANE_INKS[(lane - 1) % LANE_INKS.length] as Ink;

const COLOURS: readonly PlotColour[] = ["blue", "vermilion", "green", "orange", "purple"];

/**
 * A colour for each wish in turn: the one wished for, or the next that is free; once all are in use
 * they come again, dashed.
 */
export function shareColours(wishes: readonly PlotColour[]): Pick<Ink, "colour" | "dash">[] {
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
