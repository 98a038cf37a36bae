/** Preferences stored in this browser: theme, span of the plots, keys, and the user's name. */
import { effect, signal } from "@preact/signals";
import { readStored, store } from "../stored";
import { t } from "../text/t";

export const WINDOWS_S = [5, 10, 20, 60] as const;
export type WindowS = (typeof WINDOWS_S)[number];
export type Theme = "light" | "dark";

const systemIsDark = window.matchMedia("(prefers-color-scheme: dark)");

function initialTheme(): Theme {
  const chosen = readStored("svsa.theme");
  if (chosen === "light" || chosen === "dark") return chosen;
  return systemIsDark.matches ? "dark" : "light";
}

export const theme = signal<Theme>(initialTheme());
export const windowS = signal<WindowS>(
  WINDOWS_S.find((seconds) => String(seconds) === readStored("svsa.window_s")) ?? 20,
);
/** Whether the lab shows all controls, or the basic view. */
export const areAllControlsOn = signal(readStored("svsa.controls") === "all");
/** Whether single keys are commands; Shift + Esc always is. */
export const areKeysOn = signal(readStored("svsa.keys") !== "off");
export const personName = signal(readStored("svsa.name") ?? "");

/** Maximum length of a name that the server accepts. */
export const MAX_NAME_LENGTH = 40;

export function defaultName(): string {
  const letter = () => String.fromCharCode(65 + Math.floor(26 * Math.random()));
  return t("control.defaultName", { letters: letter() + letter() + letter() });
}

/** A name in the form that the server accepts. */
export const nameForControl = (name: string): string =>
  name.trim().slice(0, MAX_NAME_LENGTH).trim() || defaultName();

export function setKeysOn(isOn: boolean): void {
  areKeysOn.value = isOn;
  store("svsa.keys", isOn ? "on" : "off");
}

export function toggleAllControls(): void {
  areAllControlsOn.value = !areAllControlsOn.peek();
  store("svsa.controls", areAllControlsOn.peek() ? "all" : "basic");
}

export function setPersonName(name: string): void {
  personName.value = name;
  store("svsa.name", name);
}

export function toggleTheme(): void {
  theme.value = theme.peek() === "dark" ? "light" : "dark";
  store("svsa.theme", theme.peek());
}

export function setWindow(seconds: WindowS): void {
  windowS.value = seconds;
  store("svsa.window_s", String(seconds));
}

systemIsDark.addEventListener("change", () => {
  if (readStored("svsa.theme") === null) theme.value = systemIsDark.matches ? "dark" : "light";
});

effect(() => {
  document.documentElement.dataset.theme = theme.value;
});
