/** Camera presets; viser's first camera is one of them. */
import presets from "../../../../scene/svsa_scene/cameras.json";

type Point = readonly [number, number, number];
/** What the scene shows. */
export type SceneKind = keyof typeof presets;
export type CameraName = { [K in SceneKind]: keyof (typeof presets)[K] }[SceneKind];

/** A camera in the scene's coordinates; fov: vertical field of view, degrees. */
export interface View {
  position: Point;
  look_at: Point;
  fov_deg: number;
}

/** aspect: width over height of the narrowest picture that shows the whole scene from there. */
interface Preset extends View {
  aspect: number;
}

export const cameraNames = (kind: SceneKind): CameraName[] =>
  Object.keys(presets[kind]) as CameraName[];

/** Position of a preset: farther away if the picture is too narrow for it. */
export function placeCamera(name: CameraName, aspect: number, kind: SceneKind = "actuator"): View {
  const named = presets[kind] as unknown as Record<CameraName, Preset>;
  const { position, look_at, fov_deg, aspect: least } = named[name];
  const away = Math.max(1, least / aspect);
  const move = (axis: 0 | 1 | 2) => look_at[axis] + away * (position[axis] - look_at[axis]);
  return { position: [move(0), move(1), move(2)], look_at, fov_deg };
}

/** Query of viser's address that sets the first camera. */
export function addressOf({ position, look_at, fov_deg }: View): string {
  const fov = (fov_deg * Math.PI) / 180;
  return `initialCameraPosition=${position}&initialCameraLookAt=${look_at}&initialCameraFov=${fov}`;
}
