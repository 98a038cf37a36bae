/** Arms: joints with an actuator in each, as one session. */
import { call } from "./operations";
import { WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";
import type { Configuration } from "./types";

export type ArmSetup = NonNullable<Configuration["arm"]>;
export type ArmRow = components["schemas"]["NamedArmState"];
/** Fields that are left out keep their values. */
export type ArmPatch = Partial<Omit<ArmSetup, "other_joints">>;

export const readArms = () => call("get", "/arms", {});

/** The first one compiles its control loop. actuators: of each joint; those of the arm if left out. */
export const openArm = (arm: string, actuators?: readonly string[]) =>
  call("post", "/sessions", { body: { from: "arm", arm, actuators } }, WORK_TIMEOUT_MS);
