/** The list of plots and their channels, as the user arranged them and the browser stores them. */
import { computed, signal } from "@preact/signals";
import { configurationsOf } from "../state/joints";
import { areAllControlsOn } from "../state/preferences";
import { session } from "../state/session";
import { readStored, store } from "../stored";
import { sourcesOf } from "../stream/derived";
import { CHANNELS, type ChannelName, isChannel, PRESETS, type PresetName } from "./channels";
import { ESTIMATE } from "./estimate";

export const PRESET_NAMES = Object.keys(PRESETS) as PresetName[];
const AT_FIRST: readonly PresetName[] = ["position", "error", "stiffness", "torque", "disturbance"];

export interface PlotSetup {
  key: string;
  /** "own" for a plot that the user started with a selected channel. */
  preset: PresetName | "own";
  channels: readonly ChannelName[];
}

export const MAX_PLOTS = 16;
const STORE = "svsa.plots";
/** Channels that the numbers on the page need, whatever is plotted. */
const ALWAYS: readonly ChannelName[] = ["position_error_rad"];

const isPreset = (name: unknown): name is PresetName =>
  typeof name === "string" && Object.hasOwn(PRESETS, name);

const ofPreset = (preset: PresetName): PlotSetup => ({
  key: preset,
  preset,
  channels: PRESETS[preset],
});

const phaseOf = (channels: readonly ChannelName[]): PlotSetup => ({
  ...ofPreset("phase"),
  channels,
});

/** The plots of the basic view, independent of the user's arrangement. */
export const BASIC_SETUPS: readonly PlotSetup[] = [ofPreset("position"), ofPreset("error")];

const setupsAtFirst = (): PlotSetup[] => AT_FIRST.map(ofPreset);

function readSetup(stored: unknown, index: number): PlotSetup[] {
  if (typeof stored !== "object" || stored === null) return [];
  const { preset, channels } = stored as { preset?: unknown; channels?: unknown };
  const known = Array.isArray(channels) ? channels.filter(isChannel) : [];
  const ofOneUnit = known.filter((name) => CHANNELS[name].unit === CHANNELS[known[0] ?? name].unit);
  if (preset === "phase") return [known.length === 2 ? phaseOf(known) : ofPreset(preset)];
  if (isPreset(preset)) {
    return [ofOneUnit.length > 0 ? { key: preset, preset, channels: ofOneUnit } : ofPreset(preset)];
  }
  return ofOneUnit.length > 0 ? [{ key: `own${index}`, preset: "own", channels: ofOneUnit }] : [];
}

/** Validate the stored arrangement; null if nothing of it is valid. */
export function readSetups(stored: string | null): PlotSetup[] | null {
  if (stored === null) return null;
  let rows: unknown;
  try {
    rows = JSON.parse(stored);
  } catch {
    return null;
  }
  if (!Array.isArray(rows)) return null;
  const setups = new Map<string, PlotSetup>();
  for (const setup of rows.slice(0, MAX_PLOTS).flatMap(readSetup)) setups.set(setup.key, setup);
  return [...setups.values()];
}

export const setups = signal<readonly PlotSetup[]>(
  readSetups(readStored(STORE)) ?? setupsAtFirst(),
);

/** Channels that are shown outside the plots. */
export const alsoDrawn = signal<readonly ChannelName[]>([]);

let wasOn = false;
/** Whether the spring estimator is or was on since the page was opened: its past stays visible. */
const hasEstimate = computed(() => {
  const state = session.value;
  wasOn ||= state !== null && configurationsOf(state).some(({ spring }) => spring?.is_on);
  return wasOn;
});
const OF_ESTIMATE: readonly ChannelName[] = [
  ESTIMATE,
  "stiffness_deviation_nm_per_rad",
  "spring_misfit",
];

/** Without the stiffness estimate while there is none. */
export const withoutMissing = (channels: readonly ChannelName[]): readonly ChannelName[] =>
  hasEstimate.value ? channels : channels.filter((name) => name !== ESTIMATE);

/** Channels that the stream must carry. */
export const channelsInUse = computed(() => [
  ...new Set(
    [
      ...ALWAYS,
      ...alsoDrawn.value,
      ...(hasEstimate.value ? OF_ESTIMATE : []),
      ...[...setups.value, ...(areAllControlsOn.value ? [] : BASIC_SETUPS)].flatMap(
        ({ channels }) => withoutMissing(channels),
      ),
    ].flatMap(sourcesOf),
  ),
]);

function arrange(next: readonly PlotSetup[]): void {
  setups.value = next;
  store(STORE, JSON.stringify(next.map(({ preset, channels }) => ({ preset, channels }))));
}

/** Add a predefined plot at its position, or remove it. */
export function togglePreset(preset: PresetName): void {
  const rest = setups.peek().filter((setup) => setup.key !== preset);
  if (rest.length < setups.peek().length) {
    arrange(rest);
    return;
  }
  const order = (setup: PlotSetup) =>
    setup.preset === "own" ? PRESET_NAMES.length : PRESET_NAMES.indexOf(setup.preset);
  arrange([...rest, ofPreset(preset)].sort((a, b) => order(a) - order(b)));
}

export function addOwnPlot(channel: ChannelName): void {
  const taken = setups.peek().map((setup) => setup.key);
  let number = 0;
  while (taken.includes(`own${number}`)) number++;
  arrange([...setups.peek(), { key: `own${number}`, preset: "own", channels: [channel] }]);
}

export function removePlot(key: string): void {
  arrange(setups.peek().filter((setup) => setup.key !== key));
}

/** Add a channel to a plot or remove it; the last one stays. */
export function toggleChannel(key: string, channel: ChannelName): void {
  arrange(
    setups.peek().map((setup) => {
      if (setup.key !== key) return setup;
      const rest = setup.channels.filter((name) => name !== channel);
      if (rest.length === 0) return setup;
      const isThere = rest.length < setup.channels.length;
      return { ...setup, channels: isThere ? rest : [...rest, channel] };
    }),
  );
}

/** Set the two channels of the phase plane: horizontal and vertical. */
export function choosePhase(across: ChannelName, up: ChannelName): void {
  const phase = phaseOf([across, up]);
  arrange(setups.peek().map((setup) => (setup.preset === "phase" ? phase : setup)));
}

export function resetPlots(): void {
  arrange(setupsAtFirst());
}
