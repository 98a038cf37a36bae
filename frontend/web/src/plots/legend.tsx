import { text } from "../text/en";
import type { Ink, PlotSign, Trace } from "./definitions";

export interface LegendProps {
  note: string | undefined;
  traces: readonly Trace[];
  hidden: ReadonlySet<string>;
  /** The elements whose text the plot keeps up to date, by key. */
  readings: Map<string, HTMLElement>;
  onToggle: (key: string) => void;
}

const SIGN_PATHS: Readonly<Record<PlotSign, string>> = {
  none: "",
  circle: "M8 3a3 3 0 1 0 6 0a3 3 0 1 0 -6 0z",
  square: "M8 0h6v6h-6z",
  triangle: "M11 -1l3.5 6h-7z",
};

/** A piece of a curve, as it is drawn. */
export function Swatch({ look, sign = "none" }: { look: Ink; sign?: PlotSign }) {
  return (
    <svg class={`swatch ink-${look.colour}`} viewBox="0 0 22 6" aria-hidden="true">
      <path
        d="M0 3h22"
        stroke-width={Math.min(3, look.width + 0.5)}
        stroke-dasharray={look.dash.map((length) => length * 0.8).join(" ") || undefined}
      />
      {sign !== "none" && <path class="swatch-sign" d={SIGN_PATHS[sign]} />}
    </svg>
  );
}

/** One entry a curve with its value; pressing an entry hides the curve. */
export function Legend({ note, traces, hidden, readings, onToggle }: LegendProps) {
  const entries = traces.filter((trace) => trace.follows === undefined);
  return (
    <div class="legend">
      {note && <span class="legend-note">{note}</span>}
      {entries.map((trace) => (
        <button
          key={trace.key}
          type="button"
          class="legend-entry"
          aria-pressed={!hidden.has(trace.key)}
          title={text.plots.toggle(trace.label)}
          onClick={() => onToggle(trace.key)}
        >
          <Swatch look={trace} sign={trace.sign} />
          {trace.label}
          <output
            ref={(element) => {
              if (element) readings.set(trace.key, element);
              else readings.delete(trace.key);
            }}
          />
        </button>
      ))}
    </div>
  );
}
