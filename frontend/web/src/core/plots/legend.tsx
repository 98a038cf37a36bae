import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { t } from "../text/t";
import type { LineStyle, PlotSign } from "./definitions";
import type { Palette } from "./linestyles";

const SIGN_PATHS: Readonly<Record<PlotSign, string>> = {
  none: "",
  circle: "M8 3a3 3 0 1 0 6 0a3 3 0 1 0 -6 0z",
  square: "M8 0h6v6h-6z",
  triangle: "M11 -1l3.5 6h-7z",
};

interface SwatchProps {
  look: Omit<LineStyle, "colour"> & { colour: keyof Palette };
  sign?: PlotSign | undefined;
}

/** A piece of a curve, as it is drawn. */
export function Swatch({ look, sign = "none" }: SwatchProps) {
  return (
    <svg
      class="swatch"
      style={{ "--line-color": `var(--plot-${look.colour})` }}
      viewBox="0 0 22 6"
      aria-hidden="true"
    >
      <path
        d="M0 3h22"
        stroke-width={Math.min(3, look.width + 0.5)}
        stroke-dasharray={look.dash.map((length) => length * 0.8).join(" ") || undefined}
      />
      {sign !== "none" && <path class="swatch-sign" d={SIGN_PATHS[sign]} />}
    </svg>
  );
}

interface LegendEntry extends LineStyle {
  key: string;
  label: string;
  sign?: PlotSign;
  /** Content behind the label. */
  remark?: ComponentChildren;
}

interface LegendProps {
  class?: string;
  note?: string | undefined;
  entries: readonly LegendEntry[];
  hidden: ReadonlySet<string>;
  onToggle: (key: string) => void;
  /** The elements whose text the plot updates, by key; undefined: no values. */
  readings?: Map<string, HTMLElement>;
  /** Whether an entry has one value; by default each has. */
  isRead?: (key: string) => boolean;
}

/** The hidden curves, and the function that hides or shows one. */
export function useHidden() {
  const hidden = useSignal<ReadonlySet<string>>(new Set());
  const toggle = (key: string) => {
    const next = new Set(hidden.peek());
    if (!next.delete(key)) next.add(key);
    hidden.value = next;
  };
  return [hidden, toggle] as const;
}

const SHORT = 5;

/** In a narrow legend the reference is cut first, and a short name, such as FL or θ₁, last. */
function widthClassOf({ label, colour }: LegendEntry): string {
  if (label.length <= SHORT) return "is-short";
  return colour === "reference" ? "is-reference" : "";
}

/** One entry per curve with its value; a click hides the curve. */
export function Legend({ note, entries, hidden, onToggle, ...rest }: LegendProps) {
  const { class: look = "legend", readings, isRead = () => true } = rest;
  return (
    <div class={look}>
      {note && (
        <span class="legend-note" title={note}>
          {note}
        </span>
      )}
      {entries.map((entry) => (
        <button
          key={entry.key}
          type="button"
          class={`legend-entry ${widthClassOf(entry)}`}
          aria-pressed={!hidden.has(entry.key)}
          title={t("plots.toggle", { label: entry.label })}
          onClick={() => onToggle(entry.key)}
        >
          <Swatch look={entry} sign={entry.sign} />
          <span class="legend-name">{entry.label}</span>
          {entry.remark}
          {readings && isRead(entry.key) && (
            <output
              ref={(element) => {
                if (element) readings.set(entry.key, element);
                else readings.delete(entry.key);
              }}
            />
          )}
        </button>
      ))}
    </div>
  );
}
