import { setWindow, WINDOWS_S, type WindowS, windowS } from "../state/preferences";
import { t } from "../text/t";
import { formatFixed } from "../units";
import { useLiveText } from "../widgets/live";
import { areCursorsOn, toggleCursors } from "./cursors";
import { isZoomOn, toggleZoom } from "./eventzoom";
import { PlotPicker } from "./picker";
import { saveWindowCsv } from "./save";
import { freeze, frozen, goLive, isFrozen, secondsBehind, showLength, zoom } from "./span";

const ZOOM = 1.6;
const readBehind = () => t("plots.behind", { seconds: formatFixed(secondsBehind(), 1) });

function WindowPicker() {
  const span = frozen.value;
  const choose = (seconds: WindowS) => {
    setWindow(seconds);
    showLength(seconds);
  };
  return (
    <fieldset class="line small tight window-picker" aria-label={t("plots.window")}>
      {WINDOWS_S.map((seconds) => {
        const isThis =
          span === null
            ? windowS.value === seconds
            : Math.abs(span.to - span.from - seconds) < 1e-6;
        return (
          <label key={seconds} class="chip">
            <input
              type="radio"
              name="window"
              checked={isThis}
              onChange={() => choose(seconds)}
              onClick={() => choose(seconds)}
            />
            <span>{t("plots.seconds", { seconds })}</span>
          </label>
        );
      })}
    </fieldset>
  );
}

/** How far the session has advanced since the plots were frozen. */
function Behind() {
  const element = useLiveText<HTMLSpanElement>(readBehind);
  return <span class="tabular behind" ref={element} aria-hidden="true" />;
}

function HoldButton() {
  if (isFrozen.value) {
    return (
      <button
        type="button"
        class="button is-small tool is-primary"
        title={t("plots.liveHint")}
        onClick={goLive}
      >
        <svg viewBox="0 0 12 12" aria-hidden="true">
          <path d="M2 1l8 5-8 5zM10.4 1H12v10h-1.6z" />
        </svg>
        {t("plots.live")}
        <Behind />
      </button>
    );
  }
  return (
    <button type="button" class="button is-small tool" title={t("plots.holdHint")} onClick={freeze}>
      <svg viewBox="0 0 12 12" aria-hidden="true">
        <path d="M2 1h3v10H2zM7 1h3v10H7z" />
      </svg>
      {t("plots.hold")}
    </button>
  );
}

interface ZoomButtonProps {
  name: string;
  factor: number;
  path: string;
}

function ZoomButton({ name, factor, path }: ZoomButtonProps) {
  return (
    <button
      type="button"
      class="button is-small tool is-icon"
      aria-label={name}
      title={`${name}. ${t("plots.gestures")}`}
      onClick={() => zoom(factor)}
    >
      <svg viewBox="0 0 12 12" aria-hidden="true">
        <path d={path} />
      </svg>
    </button>
  );
}

/** Commands of all plots; `isBasic` leaves out the selection of plots. */
export function Toolbar({ isBasic }: { isBasic: boolean }) {
  return (
    <div class="row tight plot-tools" role="toolbar" aria-label={t("plots.tools")}>
      <fieldset class="line tight" aria-label={t("plots.view")}>
        <HoldButton />
        <button
          type="button"
          class="button is-small tool"
          aria-pressed={isZoomOn.value}
          aria-keyshortcuts="Z"
          title={t("zoom.switchHint")}
          onClick={toggleZoom}
        >
          {t("zoom.switch")}
        </button>
      </fieldset>
      <span class="visually-hidden" role="status">
        {isFrozen.value ? t("plots.held") : ""}
      </span>
      {(!isBasic || areCursorsOn.value) && (
        <button
          type="button"
          class="button is-small tool"
          aria-pressed={areCursorsOn.value}
          title={t("cursors.switchHint")}
          onClick={toggleCursors}
        >
          <svg viewBox="0 0 12 12" aria-hidden="true">
            <path d="M3 0h1.4v12H3zM7.6 0H9v12H7.6z" />
          </svg>
          {t("cursors.switch")}
        </button>
      )}
      {!isBasic && (
        <>
          <WindowPicker />
          <span class="line tight">
            <ZoomButton name={t("plots.zoomOut")} factor={ZOOM} path="M1 5.2h10v1.6H1z" />
            <ZoomButton
              name={t("plots.zoomIn")}
              factor={1 / ZOOM}
              path="M1 5.2h4.2V1h1.6v4.2H11v1.6H6.8V11H5.2V6.8H1z"
            />
          </span>
          <span class="line tight end">
            <PlotPicker />
            <button
              type="button"
              class="button is-small tool"
              title={t("save.allHint")}
              onClick={saveWindowCsv}
            >
              {t("save.csv")}
            </button>
          </span>
        </>
      )}
    </div>
  );
}
