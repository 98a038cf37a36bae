/**
 * The labels of the 3D view: viser's own labels, which overlap, are hidden, and each is drawn where
 * there is space, with a line to its part.
 */
import { useEffect, useRef } from "preact/hooks";
import { type Box, LabelPlaces, type LabelRequest, lineEnd, type PlacedLabel } from "./labelplaces";
import {
  findOnPicture,
  isOccluded,
  type SceneObject,
  type SeeingCamera,
  transform,
  type Vector,
} from "./projection";

interface LabelNode {
  message: { type: string; props: { text?: string } };
  visibility?: boolean;
  effectiveVisibility?: boolean;
}

interface LabelledViser {
  messageQueue: Record<string, unknown>[];
  camera: SeeingCamera | null;
  nodeRefFromName: Record<string, SceneObject | undefined>;
  nodePoseData: Record<string, { position: Vector } | undefined>;
  requestRender(): void;
}

interface LabelledWindow extends Window {
  __viserMutable?: LabelledViser;
  __viserSceneTree?: { getState(): Record<string, LabelNode | undefined> };
}

interface Shown {
  key: string;
  text: string;
  /** In the coordinates of the camera. */
  point: Vector;
}

const PARTS = "/a";
const MARGIN_PX = 4;
const FASTEST_MS = 1000 / 30;
/** Number of pictures after which a change of occlusion is detected. */
const LOOK_EVERY = 8;

const parentOf = (name: string): string => name.slice(0, name.lastIndexOf("/"));

/** Labels of the visible parts; viser draws none of them. */
function readLabels(viser: LabelledViser, tree: Record<string, LabelNode | undefined>): Shown[] {
  const shown: Shown[] = [];
  for (const [key, node] of Object.entries(tree)) {
    if (node?.message.type !== "LabelMessage") continue;
    if (node.visibility ?? true) {
      const message = {
        type: "SetSceneNodeVisibilityMessage",
        name: key,
        visible: false,
        owner: "",
      };
      viser.messageQueue.push(message);
      viser.requestRender();
    }
    const text = node.message.props.text ?? "";
    const parent = parentOf(key);
    const [frame, pose] = [viser.nodeRefFromName[parent], viser.nodePoseData[key]];
    if (frame && pose && text !== "" && tree[parent]?.effectiveVisibility) {
      shown.push({ key, text, point: transform(frame.matrixWorld, pose.position) });
    }
  }
  return shown;
}

/** The label and line elements of one view. */
class Sheet {
  readonly #spans = new Map<string, HTMLSpanElement>();
  readonly #lines = new Map<string, SVGLineElement>();
  readonly #covered = new Map<string, boolean>();
  readonly #places = new LabelPlaces();
  #turn = 0;
  #shown = "";

  constructor(
    private readonly sheet: HTMLElement,
    private readonly drawing: SVGSVGElement,
  ) {}

  draw(frame: HTMLIFrameElement): void {
    const { __viserMutable: viser, __viserSceneTree: source } = (frame.contentWindow ??
      {}) as LabelledWindow;
    const camera = viser?.camera;
    const parts = viser?.nodeRefFromName[PARTS];
    if (!viser || !camera || !parts || !source) {
      this.#show([]);
      return;
    }
    const picture = this.#boxOf(frame);
    this.#turn++;
    const labels = readLabels(viser, source.getState());
    const requests = labels.flatMap(({ key, text, point }, index): LabelRequest[] => {
      if (!this.#covered.has(key) || (this.#turn + index) % LOOK_EVERY === 0) {
        this.#covered.set(key, isOccluded(camera, point, parts));
      }
      const picturePoint = this.#covered.get(key) ? null : findOnPicture(camera, point);
      if (picturePoint === null) return [];
      const { offsetWidth: width, offsetHeight: height } = this.#write(key, text);
      const [x, y] = [
        picture.left + picturePoint.x * picture.width,
        picture.top + picturePoint.y * picture.height,
      ];
      return [{ key, x, y, width, height }];
    });
    this.#show(this.#places.place(requests, this.#fieldOf(picture), this.#listTaken()));
  }

  #boxOf(element: Element): Box {
    const [own, other] = [this.sheet.getBoundingClientRect(), element.getBoundingClientRect()];
    const { width, height } = other;
    return { left: other.left - own.left, top: other.top - own.top, width, height };
  }

  #fieldOf({ left, top, width, height }: Box): Box {
    return {
      left: left + MARGIN_PX,
      top: top + MARGIN_PX,
      width: width - 2 * MARGIN_PX,
      height: height - 2 * MARGIN_PX,
    };
  }

  /** The other elements over the picture. */
  #listTaken(): Box[] {
    const parent = this.sheet.parentElement as HTMLElement;
    return [...parent.querySelectorAll("[data-over-picture]")].map((element) =>
      this.#boxOf(element),
    );
  }

  #write(key: string, text: string): HTMLSpanElement {
    const known = this.#spans.get(key);
    if (known?.dataset.text === text) return known;
    const span = known ?? this.sheet.appendChild(document.createElement("span"));
    const [base, index] = text.split("_");
    span.dataset.text = text;
    span.translate = false;
    span.replaceChildren(base as string);
    if (index) span.appendChild(document.createElement("sub")).textContent = index;
    this.#spans.set(key, span);
    return span;
  }

  #show(placed: readonly PlacedLabel[]): void {
    // The same places again would be laid out again.
    const places = JSON.stringify(placed);
    if (places === this.#shown) return;
    this.#shown = places;
    const shown = new Map(placed.map((label) => [label.key, label]));
    for (const [key, span] of this.#spans) {
      const label = shown.get(key);
      span.style.visibility = label ? "visible" : "hidden";
      if (label) span.style.translate = `${label.left.toFixed(1)}px ${label.top.toFixed(1)}px`;
    }
    for (const label of placed) this.#drawLine(label);
    for (const [key, line] of this.#lines) {
      line.style.visibility = shown.has(key) ? "visible" : "hidden";
    }
  }

  #drawLine(label: PlacedLabel): void {
    let line = this.#lines.get(label.key);
    if (!line) {
      line = document.createElementNS("http://www.w3.org/2000/svg", "line");
      this.#lines.set(label.key, this.drawing.appendChild(line));
    }
    const end = lineEnd(label);
    for (const [name, value] of Object.entries({
      x1: label.x,
      y1: label.y,
      x2: end.x,
      y2: end.y,
    })) {
      line.setAttribute(name, value.toFixed(1));
    }
  }
}

/** An overlay on the frame of a view that follows it. */
export function SceneLabels({ frame }: { frame: () => HTMLIFrameElement | null }) {
  const sheet = useRef<HTMLDivElement>(null);
  const drawing = useRef<SVGSVGElement>(null);
  useEffect(() => {
    if (sheet.current === null || drawing.current === null) return;
    const labels = new Sheet(sheet.current, drawing.current);
    // Not in the frames of the page: requesting one draws the page, and it is at rest most of the time.
    const timer = setInterval(() => {
      const shown = frame();
      if (shown !== null) labels.draw(shown);
    }, FASTEST_MS);
    return () => clearInterval(timer);
  }, [frame]);
  return (
    <div class="fill scene-labels" ref={sheet} aria-hidden="true">
      <svg class="fill" ref={drawing} />
    </div>
  );
}
