/** Which of the marks above the plots have their names beside them, and on which side. */

export interface PlacedMark {
  x: number;
  /** What its name takes, px. */
  room: number;
  /** Who is named first where there is not room for all: the smallest. */
  rank: number;
}

export type Side = "right" | "left" | null;

const HALF_MARK_PX = 6;
const OFFSET_PX = 7;
/** A name may begin so far beyond the left edge. */
const OVERHANG_PX = 50;

/** A fault before a load, a load before any other change. */
export const rankOf = (kind: string): number =>
  kind === "fault" ? 0 : kind === "load_on" || kind === "load_off" ? 1 : 2;

/** marks: in the order of time; of equal rank the newest is named first. */
export function nameMarks(marks: readonly PlacedMark[], width: number): Side[] {
  const taken: [number, number][] = marks.map(({ x }) => [x - HALF_MARK_PX, x + HALF_MARK_PX]);
  const isFree = (from: number, to: number) =>
    from >= -OVERHANG_PX &&
    to <= width &&
    taken.every(([left, right]) => to <= left || from >= right);
  const sides: Side[] = marks.map(() => null);
  const order = marks
    .map((mark, index) => ({ ...mark, index }))
    .sort((one, other) => one.rank - other.rank || other.index - one.index);
  for (const { x, room, index } of order) {
    const right: [number, number] = [x + OFFSET_PX, x + OFFSET_PX + room];
    const left: [number, number] = [x - OFFSET_PX - room, x - OFFSET_PX];
    const side = isFree(...right) ? "right" : isFree(...left) ? "left" : null;
    if (side === null) continue;
    taken.push(side === "right" ? right : left);
    sides[index] = side;
  }
  return sides;
}
