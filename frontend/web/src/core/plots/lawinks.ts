/** The inks of laws: each its own, as in the lab, so that a law looks the same on every page. */
import type { Law } from "../api/types";
import { lawOf } from "../state/laws";
import type { Ink } from "./definitions";
import { shareInks } from "./inks";

/** Of laws in one picture, which differ in colour while there are no more of them than colours. */
export const inksOfLaws = (names: readonly Law[]): Ink[] =>
  shareInks(names.map((name) => lawOf(name)?.ink ?? null));

/** As the background of a dot; undefined for a law that is not in the picture. */
export const dotOf = (ink: Ink | undefined) => ink && { background: `var(--plot-${ink.colour})` };
