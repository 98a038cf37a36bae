import { session } from "../../core/state/session";
import { text } from "../../core/text/en";
import { pressStop, type StopStage, stop } from "./stop";

const WORDS: Record<StopStage, string> = {
  idle: text.stop.button,
  sending: text.stop.sending,
  confirmed: text.stop.confirmed,
  unconfirmed: text.stop.again,
  refused: text.stop.refused,
};

/** Always in sight and never disabled, whatever the page believes of the connection.
 *
 * Where it is known that nothing but a simulation runs, it is as modest as any other button. */
export function StopButton() {
  const { stage } = stop.value;
  const isSimulation = session.value?.bench === null;
  return (
    <button
      type="button"
      class={`stop-button ${isSimulation ? "is-simulation" : "is-bench"}`}
      aria-keyshortcuts="Shift+Escape"
      title={isSimulation ? text.stop.doesSimulation : text.stop.doesBench}
      onClick={() => void pressStop()}
    >
      <span class="stop-sign" aria-hidden="true" />
      <strong>{WORDS[stage]}</strong>
      <small>{text.stop.keys}</small>
      {stage !== "idle" && <span class="visually-hidden">{text.stop.button}</span>}
    </button>
  );
}
