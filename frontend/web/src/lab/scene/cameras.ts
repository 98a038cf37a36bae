/** From where the page looks at the actuator; viser's first camera is one of these too. */
import presets from "../../../../scene/svsa_scene/cameras.json";

type Point = readonly [number, number, number];
export type CameraName = keyof typeof presets;

/** A camera in the scene's coordinates; fov: from the lower to the upper edge, degrees. */
export interface View {
  position: Point;
  look_at: Point;
  fov_deg: number;
}

/** aspect: width over height of the narrowest picture that shows all from there. */
interface Preset extends View {
  aspect: number;
}

export const CAMERA_NAMES = Object.keys(presets) as CameraName[];

/** From where a preset looks: farther away where the picture is too narrow for it. */
export function placeCamera(name: CameraName, aspect: number): View {
  const { position, look_at, fov_deg, aspect: least } = presets[name] as unknown as Preset;
  const away = Math.max(1, least / aspect);
  const move = (axis: 0 | 1 | 2) => look_at[axis] + away * (position[axis] - look_at[axis]);
  return { position: [move(0), move(1), move(2)], look_at, fov_deg };
}

/** What viser's address says of the first camera. */
export function addressOf({ position, look_at, fov_deg }: View): string {
  const fov = (fov_deg * Math.PI) / 180;
  return `initialCameraPosition=${position}&initialCameraLookAt=${look_at}&initialCameraFov=${fov}`;
}
