import { text } from "../text/en";
import { Popup } from "../widgets/popup";
import { ChannelChoice } from "./channelchoice";
import { addOwnPlot, MAX_PLOTS, PRESET_NAMES, resetPlots, setups, togglePreset } from "./setups";

/** Which plots there are. */
export function PlotPicker() {
  const shown = setups.value;
  const isFull = shown.length >= MAX_PLOTS;
  return (
    <Popup class="tool" title={text.picker.openHint} button={text.picker.open}>
      {() => (
        <>
          <fieldset class="popup-presets">
            <legend>{text.picker.title}</legend>
            {PRESET_NAMES.map((preset) => {
              const isShown = shown.some((setup) => setup.key === preset);
              return (
                <label key={preset} class="check">
                  <input
                    type="checkbox"
                    checked={isShown}
                    disabled={isFull && !isShown}
                    onChange={() => togglePreset(preset)}
                  />
                  {text.plots.presets[preset]}
                </label>
              );
            })}
          </fieldset>
          <ChannelChoice
            name={text.picker.add}
            hint={text.picker.addHint}
            value=""
            disabled={isFull}
            onChoose={addOwnPlot}
          />
          {isFull && <p class="hint">{text.picker.full}</p>}
          <button type="button" class="button" onClick={resetPlots}>
            {text.picker.reset}
          </button>
        </>
      )}
    </Popup>
  );
}
