import { t } from "../text/t";
import { Popup } from "../widgets/popup";
import { CHANNELS_BY_UNIT, type ChannelName, unitOf } from "./channels";
import type { Trace } from "./definitions";
import { ChannelChoice } from "./picker";
import { savePlotCsv, savePng, saveSvg } from "./save";
import { choosePhase, type PlotSetup, removePlot, toggleChannel } from "./setups";

interface PlotMenuProps {
  setup: PlotSetup;
  title: string;
  traces: readonly Trace[];
  hidden: ReadonlySet<string>;
}

/** The channels that a plot may contain: those with its unit. */
function Curves({ setup }: { setup: PlotSetup }) {
  const unit = unitOf(setup.channels);
  const channels = CHANNELS_BY_UNIT.find((group) => group.unit === unit)?.channels ?? [];
  return (
    <fieldset>
      <legend>{t("picker.curves")}</legend>
      {channels.map((channel) => {
        const isShown = setup.channels.includes(channel);
        return (
          <label key={channel} class="line check">
            <input
              type="checkbox"
              checked={isShown}
              disabled={isShown && setup.channels.length === 1}
              onChange={() => toggleChannel(setup.key, channel)}
            />
            {t(`channelNames.${channel}`)}
          </label>
        );
      })}
      <p class="hint">{t("picker.oneUnit", { unit })}</p>
    </fieldset>
  );
}

/** The two channels of the phase plane. */
function Axes({ channels }: PlotSetup) {
  const [across, up] = channels as readonly [ChannelName, ChannelName];
  return (
    <fieldset class="popup-axes">
      <legend>{t("picker.axes")}</legend>
      <ChannelChoice
        name={t("picker.up")}
        value={up}
        onChoose={(next) => choosePhase(across, next)}
      />
      <ChannelChoice
        name={t("picker.across")}
        value={across}
        onChoose={(next) => choosePhase(next, up)}
      />
    </fieldset>
  );
}

/** The commands of one plot. */
export function PlotMenu({ setup, title, traces, hidden }: PlotMenuProps) {
  const shown = traces.filter(({ key, follows }) => !hidden.has(follows ?? key));
  return (
    <Popup
      class="quiet rigid muted strong plot-menu"
      name={t("picker.menu", { plot: title })}
      title={t("picker.menu", { plot: title })}
      button={<span aria-hidden="true">⋯</span>}
    >
      {(close) => (
        <>
          {setup.preset === "phase" ? <Axes {...setup} /> : <Curves setup={setup} />}
          <fieldset class="row tight">
            <legend>{t("save.title")}</legend>
            <button
              type="button"
              class="button"
              title={t("save.pngHint")}
              onClick={() => {
                void savePng(title, setup, shown);
                close();
              }}
            >
              {t("save.png")}
            </button>
            <button
              type="button"
              class="button"
              title={t("save.svgHint")}
              onClick={() => {
                saveSvg(title, setup, shown);
                close();
              }}
            >
              {t("save.svg")}
            </button>
            <button
              type="button"
              class="button"
              title={t("save.csvHint")}
              onClick={() => {
                savePlotCsv(title, setup);
                close();
              }}
            >
              {t("save.csv")}
            </button>
          </fieldset>
          <button type="button" class="button" onClick={() => removePlot(setup.key)}>
            {t("picker.remove")}
          </button>
        </>
      )}
    </Popup>
  );
}
