/** Access to viser's page, which has the same origin: its camera, and its graphics quality. */
import { effect, signal } from "@preact/signals";
import { isArm } from "../../core/state/arm";
import { readStored, store } from "../../core/stored";
import { type CameraName, placeCamera, type SceneKind, type View } from "./cameras";
import { type Camera, placeOf } from "./ray";

interface Viser {
  messageQueue: Record<string, unknown>[];
  camera?: Camera;
  requestRender(): void;
}

interface ViserWindow extends Window {
  __viserMutable?: Viser;
}

/** Details that low graphics hides. */
const DISPENSABLE = ["/ground", "/a/stand", "/a/t1", "/a/t2", "/light/rim"];
/** Names of the parts, which the scene keeps hidden: `svsa_scene/names.py`. */
const NAMES = ["/a/n1", "/a/n2", "/a/c/s/n3", "/a/c/p/n4", "/a/l/v/n5", "/a/l/n6"];
const LOW_PERIOD_MS = 1000 / 15;
const STORE = "svsa.graphics";
const WAIT_MS = 100;
const UNMOVED = 0.01;

export const isLow = signal(readStored(STORE) === "low");
/** Whether this page shows the names of the parts; other pages are not affected. */
export const areNamesOn = signal(false);
const viser = signal<Viser | null>(null);

export function toggleLow(): void {
  isLow.value = !isLow.peek();
  store(STORE, isLow.peek() ? "low" : "full");
}

export function toggleNames(): void {
  areNamesOn.value = !areNamesOn.peek();
}

export const cameraNow = (): Camera | null => viser.peek()?.camera ?? null;

export const sceneKind = (): SceneKind => (isArm.value ? "arm" : "actuator");

/** The preset that the camera was last moved to. */
let sent: { name: CameraName; view: View } | null = null;

/** The initial preset of a view; returns its camera. */
export function beginAt(name: CameraName, aspect: number): View {
  sent = { name, view: placeCamera(name, aspect, sceneKind()) };
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

/**
 * Wait until viser's page has loaded in the frame. A camera that was selected, or a picture that
 * changed its shape, until then takes effect now.
 */
export function enterView(frame: HTMLIFrameElement): void {
  const loadedViser = (frame.contentWindow as ViserWindow | null)?.__viserMutable;
  if (!loadedViser?.camera) {
    if (frame.isConnected) setTimeout(() => enterView(frame), WAIT_MS);
    return;
  }
  viser.value = limitFrameRate(loadedViser);
  if (sent !== null) setCamera(sent.name);
}

/** Fit the preset to a picture of another shape, unless the user has moved the camera since. */
export function fitCamera(): void {
  const camera = cameraNow();
  if (sent === null || camera === null) return;
  const place = placeOf(camera);
  const moved = Math.hypot(...sent.view.position.map((value, axis) => value - (place[axis] ?? 0)));
  if (moved < UNMOVED) setCamera(sent.name);
}

/** Limit viser to 15 frames per second with low graphics. */
function limitFrameRate(loadedViser: Viser): Viser {
  const draw = loadedViser.requestRender.bind(loadedViser);
  let last = 0;
  let isWaiting = false;
  loadedViser.requestRender = () => {
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
  return loadedViser;
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

/** Show or hide the details and the names, whenever the setting or the view changes. */
export function watchGraphics(): void {
  effect(() => show(DISPENSABLE, !isLow.value));
  effect(() => show(NAMES, areNamesOn.value));
}
