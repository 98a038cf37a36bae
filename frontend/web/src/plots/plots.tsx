import { computed } from "@preact/signals";
import { laneNames } from "../state/lanes";
import { chooseWindow, WINDOWS_S, windowS } from "../state/preferences";
import { isLive } from "../state/session";
import { text } from "../text/en";
import { PLOTS_ALONE } from "./alone";
import { comparePlots } from "./compared";
import { Plot } from "./plot";

/** Other plots, and so other keys for them, as soon as other laws run. */
const shown = computed(() => {
  const names = laneNames.value;
  const isComparison = names.length > 1;
  return {
    key: isComparison ? names.join() : "",
    definitions: isComparison ? comparePlots(names) : PLOTS_ALONE,
  };
});

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
  const { key, definitions } = shown.value;
  return (
    <section
      class={`plots ${isLive.value ? "" : "is-frozen"}`}
      aria-label={text.plots.heading}
      id="plots"
    >
      {definitions.map((definition, index) => (
        <Plot
          key={`${definition.key}.${key}`}
          definition={definition}
          isFirst={index === 0}
          isLast={index === definitions.length - 1}
        />
      ))}
      <WindowPicker />
    </section>
  );
}
