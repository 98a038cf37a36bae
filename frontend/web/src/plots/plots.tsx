import { chooseWindow, WINDOWS_S, windowS } from "../state/preferences";
import { isLive } from "../state/session";
import { text } from "../text/en";
import { PLOTS } from "./definitions";
import { Plot } from "./plot";

function WindowPicker() {
  return (
    <fieldset class="window-picker">
      <legend>{text.plots.window}</legend>
      {WINDOWS_S.map((seconds) => (
        <label key={seconds} class="chip">
          <input
            type="radio"
            name="window"
            checked={windowS.value === seconds}
            onChange={() => chooseWindow(seconds)}
          />
          <span>{text.plots.seconds(seconds)}</span>
        </label>
      ))}
    </fieldset>
  );
}

/** All plots, on one axis of time. */
export function Plots() {
  return (
    <section
      class={`plots ${isLive.value ? "" : "is-frozen"}`}
      aria-label={text.plots.heading}
      id="plots"
    >
      {PLOTS.map((definition, index) => (
        <Plot
          key={definition.key}
          definition={definition}
          isFirst={index === 0}
          isLast={index === PLOTS.length - 1}
        />
      ))}
      <WindowPicker />
    </section>
  );
}
