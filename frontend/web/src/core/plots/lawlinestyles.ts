/** The line styles of laws: each its own, as in the lab, so that a law looks the same on every page. */
import type { Law } from "../api/types";
import { lawOf } from "../state/laws";
import type { LineStyle } from "./definitions";
import { shareLineStyles } from "./linestyles";

/** Of laws in one picture, which differ in colour while there are no more of them than colours. */
export const lineStylesOfLaws = (names: readonly Law[]): LineStyle[] =>
  shareLineStyles(names.map((name) => lawOf(name)?.line_style ?? null));

/** As the background of a dot; undefined for a law that is not in the picture. */
export const dotOf = (lineStyle: LineStyle | undefined) =>
  lineStyle && { background: `var(--plot-${lineStyle.colour})` };
