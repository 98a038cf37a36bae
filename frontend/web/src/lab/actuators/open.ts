/** Reads the actuators when the page opens. */
import { readActuators } from "../../core/api/actuators";
import { actuators } from "../../core/state/actuators";

const RETRY_MS = 2000;

/** Once; repeated until the server answers. */
export async function openActuators(): Promise<void> {
  try {
    actuators.value = await readActuators();
  } catch {
    setTimeout(() => void openActuators(), RETRY_MS);
  }
}
