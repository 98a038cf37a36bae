/** The way into viser's page, which shares this page's origin: its camera, and how much it draws. */
import { effect, signal } from "@preact/signals";
import { remember, remembered } from "../state/storage";
import type { Camera } from "./ray";

interface Viser {
  messageQueue: Record<string, unknown>[];
  camera?: Camera;
  requestRender(): void;
}

interface ViserWindow extends Window {
  __viserMutable?: Viser;
}

type Point = readonly [number, number, number];
export type CameraName = "start" | "front" | "side" | "spring";

/** aspect: width over height of the narrowest picture that shows all from there. */
interface Preset {
  position: Point;
  look_at: Point;
  aspect: number;
}

const CAMERAS: Record<CameraName, Preset> = {
  start: { position: [7.84, 5.06, 1.74], look_at: [-0.75, -0.27, -0.74], aspect: 0.9 },
  front: { position: [9.4, 0.01, 0], look_at: [0.6, 0, -0.5], aspect: 0.75 },
  side: { position: [-1.03, 11.5, 0.2], look_at: [-1.03, 0, -0.55], aspect: 1.08 },
  spring: { position: [4.4, 1.5, 1.3], look_at: [0.6, 0, 0.05], aspect: 1.15 },
};
export const CAMERA_NAMES = Object.keys(CAMERAS) as CameraName[];

/** What the picture can do without. */
const DISPENSABLE = ["/ground", "/a/stand", "/a/t1", "/a/t2", "/light/rim"];
/** The names of the parts, which the scene holds hidden: `svsa_scene/names.py`. */
const NAMES = ["/a/n1", "/a/n2", "/a/c/n3", "/a/c/p/n4", "/a/l/n5", "/a/l/n6"];
const LOW_PERIOD_MS = 1000 / 15;
const STORE = "svsa.graphics";
const WAIT_MS = 100;
const PATIENCE = 300;

export const isLow = signal(remembered(STORE) === "low");
/** Whether this page names the parts; that of nobody else does. */
export const areNamesOn = signal(false);
const viser = signal<Viser | null>(null);

export function toggleLow(): void {
  isLow.value = !isLow.peek();
  remember(STORE, isLow.peek() ? "low" : "full");
}

export function toggleNames(): void {
  areNamesOn.value = !areNamesOn.peek();
}

/** Waits until viser's page has come up in the frame. */
export function enterView(frame: HTMLIFrameElement, tries = PATIENCE): void {
  const found = (frame.contentWindow as ViserWindow | null)?.__viserMutable;
  if (found?.camera) viser.value = hold(found);
  else if (tries > 0 && frame.isConnected) setTimeout(() => enterView(frame, tries - 1), WAIT_MS);
}

export const cameraNow = (): Camera | null => viser.peek()?.camera ?? null;

/** From where a preset looks: farther away where the picture is too narrow for it. */
export function placeCamera(
  name: CameraName,
  aspect: number,
): Record<"position" | "look_at", Point> {
  const { position, look_at, aspect: least } = CAMERAS[name];
  const away = Math.max(1, least / aspect);
  const move = (axis: 0 | 1 | 2) => look_at[axis] + away * (position[axis] - look_at[axis]);
  return { position: [move(0), move(1), move(2)], look_at };
}

export function setCamera(name: CameraName): void {
  const { position, look_at } = placeCamera(name, cameraNow()?.aspect ?? 1);
  viser
    .peek()
    ?.messageQueue.push(
      { type: "SetCameraLookAtMessage", look_at, initial: false },
      { type: "SetCameraPositionMessage", position, initial: false },
    );
  viser.peek()?.requestRender();
}

/** Lets through at most 15 wishes for a picture a second while the graphics are low. */
function hold(found: Viser): Viser {
  const draw = found.requestRender.bind(found);
  let last = 0;
  let isWaiting = false;
  found.requestRender = () => {
    const wait = isLow.peek() ? last + LOW_PERIOD_MS - performance.now() : 0;
    if (wait <= 0) {
      last = performance.now();
      draw();
    } else if (!isWaiting) {
      isWaiting = true;
      setTimeout(() => {
        isWaiting = false;
        last = performance.now();
        draw();
      }, wait);
    }
  };
  return found;
}

function show(nodes: readonly string[], visible: boolean): void {
  const messages = nodes.map((name) => ({
    type: "SetSceneNodeVisibilityMessage",
    name,
    visible,
    owner: "",
  }));
  viser.value?.messageQueue.push(...messages);
  viser.value?.requestRender();
}

/** Shows or hides what the picture can do without and the names, whenever that or the view changes. */
export function watchGraphics(): void {
  effect(() => show(DISPENSABLE, !isLow.value));
  effect(() => show(NAMES, areNamesOn.value));
}
