import { bench } from "../state/bench";
import { text } from "../text/en";
import { pressStop, type StopStage, stop } from "./stop";

const WORDS: Record<StopStage, string> = {
  idle: text.stop.button,
  sending: text.stop.sending,
  confirmed: text.stop.confirmed,
  unconfirmed: text.stop.again,
  refused: text.stop.refused,
};

/** Always in sight and never disabled, whatever the page believes of the connection. */
export function StopButton() {
  const { stage } = stop.value;
  const does = bench.value === null ? text.stop.doesSimulation : text.stop.doesBench;
  return (
    <span class="stop-plate">
      <button
        type="button"
        class="stop-button"
        aria-keyshortcuts="Shift+Escape"
        title={does}
        onClick={() => void pressStop()}
      >
        <strong>{WORDS[stage]}</strong>
        <small>{text.stop.keys}</small>
        {stage !== "idle" && <span class="visually-hidden">{text.stop.button}</span>}
      </button>
    </span>
  );
}
