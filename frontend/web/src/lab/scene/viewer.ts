/** Access to viser's page, which has the same origin: its camera, and its graphics quality. */
import { effect, signal } from "@preact/signals";
import { limitRate } from "../../core/rate";
import { isArm } from "../../core/state/arm";
import { readStored, store } from "../../core/stored";
import { type CameraName, cameraNames, placeCamera, type SceneKind, type View } from "./cameras";
import { type Camera, placeOf } from "./ray";

interface Viser {
  messageQueue: Record<string, unknown>[];
  nodeRefFromName: Record<string, object | undefined>;
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
/** A part of every scene, which low graphics keeps. */
const IN_SCENE = "/light/key";
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

function choosePreset(name: CameraName, aspect: number): View {
  sent = { name, view: placeCamera(name, aspect, sceneKind()) };
  return sent.view;
}

/** The first camera of a view that is loaded: the preset before a lost connection, or the whole. */
export function beginView(aspect: number): View {
  const name = cameraNames(sceneKind()).find((preset) => preset === sent?.name);
  return choosePreset(name ?? "whole", aspect);
}

export function setCamera(name: CameraName): void {
  const { position, look_at, fov_deg } = choosePreset(name, cameraNow()?.aspect ?? 1);
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
 * Follow viser's page in the frame. With each scene that it receives, the first one and those after
 * lost connections of its own, it returns to its first camera and shows all parts: whatever the
 * user selected before takes effect again, and the camera fits a picture that changed its shape.
 */
export function enterView(frame: HTMLIFrameElement): void {
  const page = frame.contentWindow as ViserWindow | null;
  const opened = frame.contentDocument;
  let scene: object | undefined;
  const look = () => {
    if (page === null || !frame.isConnected || frame.contentDocument !== opened) return;
    const loadedViser = page.__viserMutable;
    const received = loadedViser?.camera && loadedViser.nodeRefFromName[IN_SCENE];
    if (received && received !== scene) {
      if (scene === undefined) viser.value = limitFrameRate(loadedViser);
      else applyGraphics();
      if (sent !== null) setCamera(sent.name);
      scene = received;
    }
    setTimeout(look, WAIT_MS);
  };
  look();
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
  loadedViser.requestRender = limitRate(draw, () => (isLow.peek() ? LOW_PERIOD_MS : 0)).request;
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

function applyGraphics(): void {
  show(DISPENSABLE, !isLow.value);
  show(NAMES, areNamesOn.value);
}

/** Show or hide the details and the names, whenever the setting or the view changes. */
export function watchGraphics(): void {
  effect(applyGraphics);
}
