import { useId } from "preact/hooks";
import { t } from "../text/t";
import { Popup } from "../widgets/popup";
import { CHANNELS_BY_UNIT, type ChannelName, isChannel } from "./channels";
import { addOwnPlot, MAX_PLOTS, PRESET_NAMES, resetPlots, setups, togglePreset } from "./setups";

interface ChannelChoiceProps {
  name: string;
  /** First entry of the list if none is selected. */
  hint?: string;
  value: ChannelName | "";
  disabled?: boolean;
  onChoose: (channel: ChannelName) => void;
}

/** Select one of all channels, grouped by unit. */
export function ChannelChoice({ name, hint, value, disabled, onChoose }: ChannelChoiceProps) {
  const id = useId();
  return (
    <p class="stack tight">
      <label class="strong" for={id}>
        {name}
      </label>
      <select
        id={id}
        value={value}
        disabled={disabled}
        onChange={({ currentTarget }) => {
          if (isChannel(currentTarget.value)) onChoose(currentTarget.value);
          currentTarget.value = value;
        }}
      >
        {hint !== undefined && <option value="">{hint}</option>}
        {CHANNELS_BY_UNIT.map(({ unit, channels }) => (
          <optgroup key={unit} label={unit}>
            {channels.map((channel) => (
              <option key={channel} value={channel}>
                {t(`channelNames.${channel}`)}
              </option>
            ))}
          </optgroup>
        ))}
      </select>
    </p>
  );
}

/** Select the plots. */
export function PlotPicker() {
  const shown = setups.value;
  const isFull = shown.length >= MAX_PLOTS;
  return (
    <Popup class="button is-small tool" title={t("picker.openHint")} button={t("picker.open")}>
      {() => (
        <>
          <fieldset class="pair tight">
            <legend>{t("picker.title")}</legend>
            {PRESET_NAMES.map((preset) => {
              const isShown = shown.some((setup) => setup.key === preset);
              return (
                <label key={preset} class="line check">
                  <input
                    type="checkbox"
                    checked={isShown}
                    disabled={isFull && !isShown}
                    onChange={() => togglePreset(preset)}
                  />
                  {t(`plots.presets.${preset}`)}
                </label>
              );
            })}
          </fieldset>
          <ChannelChoice
            name={t("picker.add")}
            hint={t("picker.addHint")}
            value=""
            disabled={isFull}
            onChoose={addOwnPlot}
          />
          {isFull && <p class="hint">{t("picker.full")}</p>}
          <button type="button" class="button" onClick={resetPlots}>
            {t("picker.reset")}
          </button>
        </>
      )}
    </Popup>
  );
}
