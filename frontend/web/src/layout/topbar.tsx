import type { SessionState } from "../core/api/types";
import { SVSA } from "../core/state/actuators";
import { isArm } from "../core/state/arm";
import { theme, toggleTheme } from "../core/state/preferences";
import { isLive, session } from "../core/state/session";
import { t } from "../core/text/t";
import { HelpButton } from "../lab/keys/help";
import { CallsButton } from "../lab/script/drawer";
import { isLabShown, place } from "../runs/list/place";
import { ClassButton } from "../teaching/classroom/panel";
import { AllControlsSwitch, isBasic } from "./basic";
import { PagesMenu, Tabs } from "./pages";
import { FigurePicker, RecordButton, Transport } from "./transport";

function ThemeButton() {
  const isDark = theme.value === "dark";
  return (
    <button
      type="button"
      class="button is-icon"
      aria-label={isDark ? t("theme.toLight") : t("theme.toDark")}
      title={isDark ? t("theme.toLight") : t("theme.toDark")}
      onClick={toggleTheme}
    >
      <svg viewBox="0 0 16 16" aria-hidden="true">
        {isDark ? (
          <path d="M8 4.5a3.5 3.5 0 1 1 0 7 3.5 3.5 0 0 1 0-7zM7.3.5h1.4v2.4H7.3zM7.3 13.1h1.4v2.4H7.3zM.5 7.3h2.4v1.4H.5zM13.1 7.3h2.4v1.4h-2.4zM2.2 3.2l1-1 1.7 1.7-1 1zM11.1 12.1l1-1 1.7 1.7-1 1zM12.8 2.2l1 1-1.7 1.7-1-1zM3.9 11.1l1 1-1.7 1.7-1-1z" />
        ) : (
          <path d="M6.2 1.2a7 7 0 1 0 8.6 8.6A6 6 0 0 1 6.2 1.2z" />
        )}
      </svg>
    </button>
  );
}

function subtitleOf(state: SessionState): string {
  if (isArm.value) return t("arm.name");
  return state.actuator.name === SVSA ? t("subtitle") : state.actuator.title;
}

export function TopBar() {
  const state = session.value;
  const isLab = isLabShown(place.value);
  // An exercise sets the session up and records it; a figure of the paper would overwrite that.
  const isLesson = place.value.kind === "learn";
  return (
    <header class={isLab && !isBasic.value ? "bar topbar is-full" : "bar topbar"}>
      <h1>
        {t("name")}{" "}
        <small class="roomy">{isLab && state ? subtitleOf(state) : t("subtitle")}</small>
      </h1>
      <Tabs />
      {isLab && state && (
        <div class="row topbar-controls">
          <fieldset class="contents" disabled={!isLive.value} aria-label={t("session")}>
            {!isLesson && !isBasic.value && state.actuator.name === SVSA && !isArm.value && (
              <FigurePicker state={state} />
            )}
            {state.bench === null && <Transport state={state} isBasic={isBasic.value} />}
            {((!isLesson && !isBasic.value) || state.recording !== null) && (
              <RecordButton state={state} />
            )}
          </fieldset>
          <AllControlsSwitch />
        </div>
      )}
      <div class="line end topbar-end">
        <ClassButton />
        <PagesMenu />
        {!isBasic.value && <CallsButton />}
        <HelpButton />
        <ThemeButton />
      </div>
    </header>
  );
}
