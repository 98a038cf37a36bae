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

const CAMERAS: Record<CameraName, { position: Point; look_at: Point }> = {
  start: { position: [7.84, 5.06, 1.74], look_at: [-0.75, -0.27, -0.74] },
  front: { position: [8.6, 0.01, 0.05], look_at: [0.6, 0, -0.4] },
  side: { position: [-0.75, 11.5, 0.2], look_at: [-0.75, 0, -0.6] },
  spring: { position: [4.4, 1.5, 1.3], look_at: [0.6, 0, 0.05] },
};
export const CAMERA_NAMES = Object.keys(CAMERAS) as CameraName[];

/** What the picture can do without. */
const DISPENSABLE = ["/ground", "/a/stand", "/a/t1", "/a/t2", "/light/rim"];
const LOW_PERIOD_MS = 1000 / 15;
const STORE = "svsa.graphics";
const WAIT_MS = 100;
const PATIENCE = 300;

export const isLow = signal(remembered(STORE) === "low");
const viser = signal<Viser | null>(null);

export function toggleLow(): void {
  isLow.value = !isLow.peek();
  remember(STORE, isLow.peek() ? "low" : "full");
}

/** Waits until viser's page has come up in the frame. */
export function enterView(frame: HTMLIFrameElement, tries = PATIENCE): void {
  const found = (frame.contentWindow as ViserWindow | null)?.__viserMutable;
  if (found?.camera) viser.value = hold(found);
  else if (tries > 0 && frame.isConnected) setTimeout(() => enterView(frame, tries - 1), WAIT_MS);
}

export const cameraNow = (): Camera | null => viser.peek()?.camera ?? null;

export function setCamera(name: CameraName): void {
  const { position, look_at } = CAMERAS[name];
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

/** Shows or hides what the picture can do without, whenever that or the view changes. */
export function watchGraphics(): void {
  effect(() => {
    const visible = !isLow.value;
    const messages = DISPENSABLE.map((name) => ({
      type: "SetSceneNodeVisibilityMessage",
      name,
      visible,
      owner: "",
    }));
    viser.value?.messageQueue.push(...messages);
    viser.value?.requestRender();
  });
}
