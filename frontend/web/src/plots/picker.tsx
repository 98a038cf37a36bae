import { useId } from "preact/hooks";
import { Popup } from "../panel/popup";
import { text } from "../text/en";
import { CHANNELS_BY_UNIT, isChannel } from "./channels";
import { addOwnPlot, MOST_PLOTS, PRESET_NAMES, resetPlots, setups, togglePreset } from "./setups";

/** Begins another plot with the channel chosen. */
function AddPlot({ isFull }: { isFull: boolean }) {
  const id = useId();
  return (
    <p class="popup-add">
      <label for={id}>{text.picker.add}</label>
      <select
        id={id}
        value=""
        disabled={isFull}
        onChange={({ currentTarget }) => {
          if (isChannel(currentTarget.value)) addOwnPlot(currentTarget.value);
          currentTarget.value = "";
        }}
      >
        <option value="">{text.picker.addHint}</option>
        {CHANNELS_BY_UNIT.map(({ unit, channels }) => (
          <optgroup key={unit} label={unit}>
            {channels.map((channel) => (
              <option key={channel} value={channel}>
                {text.channelNames[channel]}
              </option>
            ))}
          </optgroup>
        ))}
      </select>
    </p>
  );
}

/** Which plots there are. */
export function PlotPicker() {
  const shown = setups.value;
  const isFull = shown.length >= MOST_PLOTS;
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
          <AddPlot isFull={isFull} />
          {isFull && <p class="hint">{text.picker.full}</p>}
          <button type="button" class="button" onClick={resetPlots}>
            {text.picker.reset}
          </button>
        </>
      )}
    </Popup>
  );
}
