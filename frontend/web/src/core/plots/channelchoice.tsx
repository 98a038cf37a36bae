import { useId } from "preact/hooks";
import { text } from "../text/en";
import { CHANNELS_BY_UNIT, type ChannelName, isChannel } from "./channels";

interface ChannelChoiceProps {
  name: string;
  /** Where none is chosen yet, what the list begins with. */
  hint?: string;
  value: ChannelName | "";
  disabled?: boolean;
  onChoose: (channel: ChannelName) => void;
}

/** One of all channels, by their units. */
export function ChannelChoice({ name, hint, value, disabled, onChoose }: ChannelChoiceProps) {
  const id = useId();
  return (
    <p class="popup-add">
      <label for={id}>{name}</label>
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
                {text.channelNames[channel]}
              </option>
            ))}
          </optgroup>
        ))}
      </select>
    </p>
  );
}
