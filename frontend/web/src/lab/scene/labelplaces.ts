/**
 * Where labels lie on a picture: each as near its part as there is room, inside the field, none over
 * another. One that lies well where it was stays there.
 */

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** A label of a part that is seen at x, y. Pixels. */
export interface Wanted {
  key: string;
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface Placed extends Wanted, Box {}

/** From a part to the middle of its label. */
interface Way {
  across: number;
  down: number;
}

const GAP_PX = 3;
const DISTANCES_PX = [5, 15, 26, 38, 52, 70, 95, 130];
const DIRECTIONS = 20;
/** What is as bad as a distance of so many pixels. */
const INWARD_PX = 14;
const COVER_PX = 30;
const CROSSING_PX = 40;
/** So good a place is kept. */
const GOOD_PX = 45;
/** Labels with room nowhere near are looked for at all places of a grid. */
const GRID_PX = 6;

const isOver = (one: Box, other: Box): boolean =>
  one.left < other.left + other.width + GAP_PX &&
  other.left < one.left + one.width + GAP_PX &&
  one.top < other.top + other.height + GAP_PX &&
  other.top < one.top + one.height + GAP_PX;

const isInside = (one: Box, field: Box): boolean =>
  one.left >= field.left &&
  one.top >= field.top &&
  one.left + one.width <= field.left + field.width &&
  one.top + one.height <= field.top + field.height;

const contains = ({ left, top, width, height }: Box, x: number, y: number): boolean =>
  x >= left && x <= left + width && y >= top && y <= top + height;

/** The end at its label of the line from a part. */
export function lineEnd({ x, y, left, top, width, height }: Placed): { x: number; y: number } {
  return {
    x: Math.max(left, Math.min(left + width, x)),
    y: Math.max(top, Math.min(top + height, y)),
  };
}

/** Whether the line of one label runs through the box of another. */
function crosses(line: Placed, box: Box): boolean {
  const end = lineEnd(line);
  const steps = Math.ceil(Math.hypot(end.x - line.x, end.y - line.y) / 5);
  for (let step = 1; step < steps; step++) {
    const share = step / steps;
    if (contains(box, line.x + share * (end.x - line.x), line.y + share * (end.y - line.y))) {
      return true;
    }
  }
  return false;
}

const boxAt = (label: Wanted, { across, down }: Way): Placed => ({
  ...label,
  left: label.x + across - label.width / 2,
  top: label.y + down - label.height / 2,
});

function listWays({ width, height }: Wanted): Way[] {
  const ways: Way[] = [];
  for (const distance of DISTANCES_PX) {
    for (let turn = 0; turn < DIRECTIONS; turn++) {
      const angle = (2 * Math.PI * turn) / DIRECTIONS;
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
      ways.push({
        across: cos * (distance + width / 2),
        down: sin * (distance + height / 2),
      });
    }
  }
  return ways;
}

function* listGrid(label: Wanted, field: Box): Generator<Way> {
  for (let down = field.top; down + label.height <= field.top + field.height; down += GRID_PX) {
    for (let left = field.left; left + label.width <= field.left + field.width; left += GRID_PX) {
      yield {
        across: left + label.width / 2 - label.x,
        down: down + label.height / 2 - label.y,
      };
    }
  }
}

/** Places labels again and again, on pictures that follow one another. */
export class LabelPlaces {
  readonly #before = new Map<string, Way>();

  /**
   * Labels that have their places; of a part outside the field there is none, nor where the field is
   * full. taken: what else lies on the picture.
   */
  place(wanted: readonly Wanted[], field: Box, taken: readonly Box[] = []): Placed[] {
    const seen = wanted.filter(({ x, y }) => contains(field, x, y));
    const middle = {
      x: seen.reduce((sum, { x }) => sum + x, 0) / seen.length,
      y: seen.reduce((sum, { y }) => sum + y, 0) / seen.length,
    };
    const placed: Placed[] = [];
    for (const label of seen) {
      const isFree = (box: Placed) =>
        isInside(box, field) && ![...taken, ...placed].some((other) => isOver(box, other));
      const judge = (way: Way) => {
        const box = boxAt(label, way);
        if (!isFree(box)) return Number.POSITIVE_INFINITY;
        return (
          costOfPlace(box, middle) +
          seen.filter((one) => one !== label && contains(box, one.x, one.y)).length * COVER_PX +
          placed.filter((one) => crosses(box, one) || crosses(one, box)).length * CROSSING_PX
        );
      };
      const before = this.#before.get(label.key);
      const best =
        before && judge(before) < GOOD_PX
          ? before
          : (findBest(listWays(label), judge) ??
            findBest(listGrid(label, field), (way) =>
              isFree(boxAt(label, way))
                ? Math.hypot(way.across, way.down)
                : Number.POSITIVE_INFINITY,
            ));
      if (best === null) this.#before.delete(label.key);
      else {
        this.#before.set(label.key, best);
        placed.push(boxAt(label, best));
      }
    }
    return placed;
  }
}

/** Short lines, and away from the other parts. */
function costOfPlace(box: Placed, middle: { x: number; y: number }): number {
  const end = lineEnd(box);
  const length = Math.hypot(end.x - box.x, end.y - box.y);
  const outward = [box.x - middle.x, box.y - middle.y] as const;
  const way = [box.left + box.width / 2 - box.x, box.top + box.height / 2 - box.y] as const;
  const sizes = Math.hypot(...outward) * Math.hypot(...way);
  const along = sizes > 0 ? (outward[0] * way[0] + outward[1] * way[1]) / sizes : 0;
  return length + (1 - along) * INWARD_PX;
}

function findBest(ways: Iterable<Way>, judge: (way: Way) => number): Way | null {
  let best: Way | null = null;
  let least = Number.POSITIVE_INFINITY;
  for (const way of ways) {
    const found = judge(way);
    if (found < least) [best, least] = [way, found];
  }
  return best;
}
