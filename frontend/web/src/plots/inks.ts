/**
 * Stable inks: who controls a lane has a colour and a dash of its own, numbered by the server, in
 * every picture; several channels of one lane have a colour each.
 */
import type { Ink, PlotColour } from "./definitions";

export const PLAIN: readonly number[] = [];
export const DASHED: readonly number[] = [6, 5];
export const DOTTED: readonly number[] = [2, 4];

const LANE_COLOURS: readonly PlotColour[] = ["blue", "vermilion", "green", "purple", "orange"];
const LANE_DASHES = [PLAIN, [9, 4], [3, 3], [10, 3, 2, 3]] as const;

/** Ink 0, 1, …: twenty, of which no two share both colour and dash, and neighbours share neither. */
export const inkOf = (ink: number): Ink => ({
  colour: LANE_COLOURS[ink % LANE_COLOURS.length] as PlotColour,
  dash: LANE_DASHES[ink % LANE_DASHES.length] as readonly number[],
  width: ink === 0 ? 2.5 : 2,
});

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
