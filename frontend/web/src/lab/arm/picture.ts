/** Draws the samples of an arm into the picture of its plane. */

import {
  axesOf,
  ellipseOf,
  type Lengths,
  type Point,
  pathOf,
  placeLinks,
  placeTip,
  reachOf,
  type StiffnessEllipse,
} from "../../core/armgeometry";
import { shownRing, shownSpan } from "../../core/plots/span";
import { limitRate } from "../../core/rate";
import type { SampleRing } from "../../core/stream/ring";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";

/** Half of the width of the picture, in its units. */
export const HALF = 200;
/** Space around the largest distance of the tip. */
export const MARGIN = 1.08;
const KILO = 1000;
const TIP_S = 3;
const REFERENCE_S = 8;
const PATH_POINTS = 160;
const PATH_MS = 60;

/** Number of the newest sample that the plots show. */
const newestShown = (ring: SampleRing): number => ring.lowerBound(shownSpan().to + 1e-9) - 1;

interface Arm {
  lengths: Lengths;
  /** Greatest stiffness of the actuators, N·m/rad. */
  most: number;
}

type Channel = "position_rad" | "position_reference_rad" | "stiffness_nm_per_rad";

/** In kN/m if the least is not a small number of them. */
function describeExtremes({ least, greatest }: StiffnessEllipse): string {
  const [unit, factor] =
    least < KILO / 10 ? ([t("arm.newtons"), 1] as const) : [t("arm.kilonewtons"), KILO];
  const [low, high] = [least, greatest].map((k) => formatNumber(k / factor, 3));
  return t("arm.extremes", { least: `${low}`, greatest: `${high}`, unit });
}

export class ArmPicture {
  /** The tip at the newest sample; null before the first. */
  tip: Point | null = null;
  /** The pointer that pulls it. */
  pointer: Point | null = null;
  readonly #scale: number;
  readonly #paths = limitRate(
    () => this.#drawPaths(),
    () => PATH_MS,
  );

  constructor(
    private readonly svg: SVGSVGElement,
    private readonly readout: HTMLElement,
    private readonly arm: Arm,
  ) {
    this.#scale = HALF / (MARGIN * reachOf(arm.lengths));
  }

  /** The newest sample that the plots show. */
  draw(): void {
    const ring = shownRing();
    const newest = newestShown(ring);
    for (const part of this.svg.querySelectorAll<SVGPathElement>("[data-links]")) {
      this.#drawLinks(part, this.#read(ring, "position_rad", newest, Number(part.dataset.links)));
    }
    const q = this.#read(ring, "position_rad", newest);
    if (q.every(Number.isFinite)) {
      this.#drawTip(q);
      this.#drawEllipse(q, this.#read(ring, "stiffness_nm_per_rad", newest));
    }
    this.#paths.request();
  }

  #drawPaths(): void {
    const ring = shownRing();
    const newest = newestShown(ring);
    for (const part of this.svg.querySelectorAll<SVGPathElement>("[data-path]")) {
      const { path } = part.dataset;
      const points =
        path === "reference"
          ? this.#listTips(ring, newest, "position_reference_rad", REFERENCE_S, 0)
          : this.#listTips(ring, newest, "position_rad", TIP_S, Number(path));
      part.setAttribute("d", pathOf(points, this.#scale));
    }
  }

  /** The joints of an arm (0: the own, 1: the comparison) at a sample. */
  #read(ring: SampleRing, channel: Channel, index: number, arm = 0): number[] {
    const { lengths } = this.arm;
    return lengths.map((_, joint) =>
      ring.valueAt(channel, index, lengths.length * arm + joint + 1),
    );
  }

  #at({ x, y }: Point): string {
    return `${(this.#scale * x).toFixed(1)} ${(-this.#scale * y).toFixed(1)}`;
  }

  #find = (name: string) => this.svg.querySelector<SVGGraphicsElement>(`[data-${name}]`);

  #move(name: string, point: Point): void {
    this.#find(name)?.setAttribute("transform", `translate(${this.#at(point)})`);
  }

  #drawLinks(part: SVGPathElement, q: readonly number[]): void {
    const isKnown = q.every(Number.isFinite);
    part.style.visibility = isKnown ? "visible" : "hidden";
    if (!isKnown) return;
    const ends = placeLinks(this.arm.lengths, q).map((end) => `L${this.#at(end)}`);
    part.setAttribute("d", `M0 0${ends.join("")}`);
  }

  #drawTip(q: readonly number[]): void {
    const joints = placeLinks(this.arm.lengths, q);
    const tip = joints.pop() as Point;
    this.tip = tip;
    for (const [index, joint] of joints.entries()) this.#move(`joint="${index}"`, joint);
    this.#move("tip", tip);
    this.#move("mass", tip);
    const band = this.pointer === null ? "" : `M${this.#at(tip)}L${this.#at(this.pointer)}`;
    this.#find("band")?.setAttribute("d", band);
  }

  #drawEllipse(q: readonly number[], stiffness: readonly number[]): void {
    const { lengths, most } = this.arm;
    const ellipse = ellipseOf(lengths, q, stiffness);
    const part = this.#find("ellipse");
    if (part === null || this.tip === null) return;
    part.style.visibility = ellipse === null ? "hidden" : "visible";
    this.readout.textContent = ellipse === null ? t("arm.straight") : describeExtremes(ellipse);
    if (ellipse === null) return;
    const [long, short] = axesOf(lengths, ellipse, most);
    const degrees = (-ellipse.angle * 180) / Math.PI;
    part.setAttribute("rx", (this.#scale * long).toFixed(1));
    part.setAttribute("ry", (this.#scale * short).toFixed(1));
    part.setAttribute(
      "transform",
      `translate(${this.#at(this.tip)}) rotate(${degrees.toFixed(1)})`,
    );
  }

  /** The path of a tip up to a sample; null where samples are missing. */
  #listTips(
    ring: SampleRing,
    newest: number,
    channel: Channel,
    lengthS: number,
    arm: number,
  ): (Point | null)[] {
    const first = Math.max(0, ring.lowerBound(ring.timeAt(newest) - lengthS));
    const stride = Math.max(1, Math.ceil((newest - first) / PATH_POINTS));
    const points: (Point | null)[] = [];
    for (let index = newest; index >= first; index -= stride) {
      const q = this.#read(ring, channel, index, arm);
      points.push(q.every(Number.isFinite) ? placeTip(this.arm.lengths, q) : null);
    }
    return points;
  }
}
