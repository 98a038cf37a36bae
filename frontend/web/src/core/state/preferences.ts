/** What this browser remembers: theme, span of the plots, keys, and who sits before it. */
import { effect, signal } from "@preact/signals";
import { controlText as text } from "../text/control";

export function remembered(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}

export function remember(key: string, value: string): void {
  try {
    localStorage.setItem(key, value);
  } catch {
    // Nothing is lost but the memory of a choice.
  }
}

export const WINDOWS_S = [5, 10, 20, 60] as const;
export type WindowS = (typeof WINDOWS_S)[number];
export type Theme = "light" | "dark";

const systemIsDark = window.matchMedia("(prefers-color-scheme: dark)");

function firstTheme(): Theme {
  const chosen = remembered("svsa.theme");
  if (chosen === "light" || chosen === "dark") return chosen;
  return systemIsDark.matches ? "dark" : "light";
}

export const theme = signal<Theme>(firstTheme());
export const windowS = signal<WindowS>(
  WINDOWS_S.find((seconds) => String(seconds) === remembered("svsa.window_s")) ?? 20,
);
/** Whether the lab shows all controls, or those of a first experiment. */
export const areAllControlsOn = signal(remembered("svsa.controls") === "all");
/** Whether single keys command the page; Shift + Esc always does. */
export const areKeysOn = signal(remembered("svsa.keys") !== "off");
export const personName = signal(remembered("svsa.name") ?? "");

/** As long as the server takes a name for who is in control. */
export const LONGEST_NAME = 40;

export function defaultName(): string {
  const letter = () => String.fromCharCode(65 + Math.floor(26 * Math.random()));
  return text.control.defaultName(letter() + letter() + letter());
}

/** A name as the server takes it. */
export const nameForControl = (name: string): string =>
  name.trim().slice(0, LONGEST_NAME).trim() || defaultName();

export function chooseKeys(isOn: boolean): void {
  areKeysOn.value = isOn;
  remember("svsa.keys", isOn ? "on" : "off");
}

export function toggleAllControls(): void {
  areAllControlsOn.value = !areAllControlsOn.peek();
  remember("svsa.controls", areAllControlsOn.peek() ? "all" : "basic");
}

export function rememberPerson(name: string): void {
  personName.value = name;
  remember("svsa.name", name);
}

export function toggleTheme(): void {
  theme.value = theme.peek() === "dark" ? "light" : "dark";
  remember("svsa.theme", theme.peek());
}

export function chooseWindow(seconds: WindowS): void {
  windowS.value = seconds;
  remember("svsa.window_s", String(seconds));
}

systemIsDark.addEventListener("change", () => {
  if (remembered("svsa.theme") === null) theme.value = systemIsDark.matches ? "dark" : "light";
});

effect(() => {
  document.documentElement.dataset.theme = theme.value;
});
