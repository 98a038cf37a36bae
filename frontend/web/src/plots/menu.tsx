import { Popup } from "../panel/popup";
import { text } from "../text/en";
import { CHANNELS_BY_UNIT, unitOf } from "./channels";
import type { Trace } from "./definitions";
import { savePlotCsv, savePng, saveSvg } from "./save";
import { type PlotSetup, removePlot, toggleChannel } from "./setups";

interface PlotMenuProps {
  setup: PlotSetup;
  title: string;
  traces: readonly Trace[];
  hidden: ReadonlySet<string>;
}

/** The channels that may stand on one plot: those of its unit. */
function Curves({ setup }: { setup: PlotSetup }) {
  const unit = unitOf(setup.channels);
  const channels = CHANNELS_BY_UNIT.find((one) => one.unit === unit)?.channels ?? [];
  return (
    <fieldset>
      <legend>{text.picker.curves}</legend>
      {channels.map((channel) => {
        const isShown = setup.channels.includes(channel);
        return (
          <label key={channel} class="check">
            <input
              type="checkbox"
              checked={isShown}
              disabled={isShown && setup.channels.length === 1}
              onChange={() => toggleChannel(setup.key, channel)}
            />
            {text.channelNames[channel]}
          </label>
        );
      })}
      <p class="hint">{text.picker.oneUnit(unit)}</p>
    </fieldset>
  );
}

/** What can be done with one plot. */
export function PlotMenu({ setup, title, traces, hidden }: PlotMenuProps) {
  const shown = traces.filter(({ key, follows }) => !hidden.has(follows ?? key));
  return (
    <Popup
      class="plot-menu"
      name={text.picker.menu(title)}
      title={text.picker.menu(title)}
      button={<span aria-hidden="true">⋯</span>}
    >
      {(close) => (
        <>
          {setup.preset !== "phase" && <Curves setup={setup} />}
          <fieldset class="popup-row">
            <legend>{text.save.title}</legend>
            <button
              type="button"
              class="button"
              title={text.save.pngHint}
              onClick={() => {
                void savePng(title, setup, shown);
                close();
              }}
            >
              {text.save.png}
            </button>
            <button
              type="button"
              class="button"
              title={text.save.svgHint}
              onClick={() => {
                saveSvg(title, setup, shown);
                close();
              }}
            >
              {text.save.svg}
            </button>
            <button
              type="button"
              class="button"
              title={text.save.csvHint}
              onClick={() => {
                savePlotCsv(title, setup);
                close();
              }}
            >
              {text.save.csv}
            </button>
          </fieldset>
          <button type="button" class="button" onClick={() => removePlot(setup.key)}>
            {text.picker.remove}
          </button>
        </>
      )}
    </Popup>
  );
}
