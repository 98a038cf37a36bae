/**
 * Positions of labels on a picture: as near to its part as possible, inside the area, without
 * overlap. A label with a good position stays there.
 */

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** A label of a visible part at x, y, px. */
export interface LabelRequest {
  key: string;
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface PlacedLabel extends LabelRequest, Box {}

/** From a part to the center of its label. */
interface Way {
  across: number;
  down: number;
}

const GAP_PX = 3;
const DISTANCES_PX = [5, 15, 26, 38, 52, 70, 95, 130];
const DIRECTIONS = 20;
/** Penalties, as equivalent distances in pixels. */
const INWARD_PX = 14;
const COVER_PX = 30;
const CROSSING_PX = 40;
/** A position with a smaller penalty is kept. */
const GOOD_PX = 45;
/** Labels without space nearby are tried at all points of a grid. */
const GRID_PX = 6;

const isOver = (box: Box, other: Box): boolean =>
  box.left < other.left + other.width + GAP_PX &&
  other.left < box.left + box.width + GAP_PX &&
  box.top < other.top + other.height + GAP_PX &&
  other.top < box.top + box.height + GAP_PX;

const isInside = (box: Box, field: Box): boolean =>
  box.left >= field.left &&
  box.top >= field.top &&
  box.left + box.width <= field.left + field.width &&
  box.top + box.height <= field.top + field.height;

const contains = ({ left, top, width, height }: Box, x: number, y: number): boolean =>
  x >= left && x <= left + width && y >= top && y <= top + height;

/** End point at its label of the line from a part. */
export function lineEnd({ x, y, left, top, width, height }: PlacedLabel): { x: number; y: number } {
  return {
    x: Math.max(left, Math.min(left + width, x)),
    y: Math.max(top, Math.min(top + height, y)),
  };
}

/** Whether the line of one label crosses the box of another. */
function crosses(line: PlacedLabel, box: Box): boolean {
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

const boxAt = (label: LabelRequest, { across, down }: Way): PlacedLabel => ({
  ...label,
  left: label.x + across - label.width / 2,
  top: label.y + down - label.height / 2,
});

function listWays({ width, height }: LabelRequest): Way[] {
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

function* listGrid(label: LabelRequest, field: Box): Generator<Way> {
  for (let down = field.top; down + label.height <= field.top + field.height; down += GRID_PX) {
    for (let left = field.left; left + label.width <= field.left + field.width; left += GRID_PX) {
      yield {
        across: left + label.width / 2 - label.x,
        down: down + label.height / 2 - label.y,
      };
    }
  }
}

/** Places labels repeatedly, on successive pictures. */
export class LabelPlaces {
  readonly #before = new Map<string, Way>();

  /**
   * Labels with their positions, without those of parts outside the area or without space. taken:
   * boxes of other elements on the picture.
   */
  place(
    requests: readonly LabelRequest[],
    field: Box,
    occupied: readonly Box[] = [],
  ): PlacedLabel[] {
    const visible = requests.filter(({ x, y }) => contains(field, x, y));
    const middle = {
      x: visible.reduce((sum, { x }) => sum + x, 0) / visible.length,
      y: visible.reduce((sum, { y }) => sum + y, 0) / visible.length,
    };
    const placed: PlacedLabel[] = [];
    for (const label of visible) {
      const isFree = (box: PlacedLabel) =>
        isInside(box, field) && ![...occupied, ...placed].some((other) => isOver(box, other));
      const judge = (way: Way) => {
        const box = boxAt(label, way);
        if (!isFree(box)) return Number.POSITIVE_INFINITY;
        return (
          costOfPlace(box, middle) +
          visible.filter((other) => other !== label && contains(box, other.x, other.y)).length *
            COVER_PX +
          placed.filter((other) => crosses(box, other) || crosses(other, box)).length * CROSSING_PX
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

/** Short lines, and distance from the other parts. */
function costOfPlace(box: PlacedLabel, middle: { x: number; y: number }): number {
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
    const cost = judge(way);
    if (cost < least) [best, least] = [way, cost];
  }
  return best;
}
