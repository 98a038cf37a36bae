/** The way into viser's page, which shares this page's origin: its camera, and how much it draws. */
import { effect, signal } from "@preact/signals";
import { remember, remembered } from "../../core/state/preferences";
import { type CameraName, placeCamera, type View } from "./cameras";
import { type Camera, placeOf } from "./ray";

interface Viser {
  messageQueue: Record<string, unknown>[];
  camera?: Camera;
  requestRender(): void;
}

interface ViserWindow extends Window {
  __viserMutable?: Viser;
}

/** What the picture can do without. */
const DISPENSABLE = ["/ground", "/a/stand", "/a/t1", "/a/t2", "/light/rim"];
/** The names of the parts, which the scene holds hidden: `svsa_scene/names.py`. */
const NAMES = ["/a/n1", "/a/n2", "/a/c/s/n3", "/a/c/p/n4", "/a/l/v/n5", "/a/l/n6"];
const LOW_PERIOD_MS = 1000 / 15;
const STORE = "svsa.graphics";
const WAIT_MS = 100;
const PATIENCE = 300;
const UNMOVED = 0.01;

export const isLow = signal(remembered(STORE) === "low");
/** Whether this page shows the names of the parts; other pages are not affected. */
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

/** The preset that the camera was last sent to. */
let sent: { name: CameraName; view: View } | null = null;

/** The view begins with a preset; returns from where that looks. */
export function beginAt(name: CameraName, aspect: number): View {
  sent = { name, view: placeCamera(name, aspect) };
  return sent.view;
}

export function setCamera(name: CameraName): void {
  const { position, look_at, fov_deg } = beginAt(name, cameraNow()?.aspect ?? 1);
  const fov = (fov_deg * Math.PI) / 180;
  viser
    .peek()
    ?.messageQueue.push(
      { type: "SetCameraFovMessage", fov, initial: false },
      { type: "SetCameraLookAtMessage", look_at, initial: false },
      { type: "SetCameraPositionMessage", position, initial: false },
    );
  viser.peek()?.requestRender();
}

/** Fits the preset to a picture of another shape, unless the user has moved the camera since. */
export function fitCamera(): void {
  const camera = cameraNow();
  if (sent === null || camera === null) return;
  const place = placeOf(camera);
  const moved = Math.hypot(...sent.view.position.map((value, axis) => value - (place[axis] ?? 0)));
  if (moved < UNMOVED) setCamera(sent.name);
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
