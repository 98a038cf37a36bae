/** A lane's place in the session is its colour, dash and width in every plot. */
import type { PlotColour } from "./definitions";

export interface Ink {
  colour: PlotColour;
  dash: readonly number[];
  width: number;
}

export const LANE_INKS: readonly Ink[] = [
  { colour: "blue", dash: [], width: 2.75 },
  { colour: "vermilion", dash: [9, 4], width: 2 },
  { colour: "green", dash: [3, 3], width: 2 },
  { colour: "purple", dash: [10, 3, 2, 3], width: 2 },
];

/** The ink of lane 1, 2, … */
export const inkOf = (lane: number): Ink => LANE_INKS[(lane - 1) % LANE_INKS.length] as Ink;
