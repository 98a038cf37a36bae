/** The colours of theme.css as the canvas needs them, read again when the theme changes. */
import { computed } from "@preact/signals";
import { theme } from "../state/preferences";
import type { PlotColour } from "./definitions";

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
