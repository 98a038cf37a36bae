import type { RefObject } from "preact";
import { text } from "../text/en";
import type { PlotDefinition, Trace } from "./definitions";

export interface LegendProps {
  definition: PlotDefinition;
  hidden: ReadonlySet<string>;
  /** The elements whose text the plot keeps up to date, by channel. */
  readings: RefObject<Map<string, HTMLElement>>;
  onToggle: (channel: string) => void;
}

function Swatch({ trace }: { trace: Trace }) {
  return (
    <svg class={`swatch ink-${trace.colour}`} viewBox="0 0 18 6" aria-hidden="true">
      <path
        d="M0 3h18"
        stroke-width={Math.min(3, (trace.width ?? 1.5) + 0.5)}
        stroke-dasharray={trace.dashed ? "5 3" : undefined}
      />
    </svg>
  );
}

/** Title, then one entry a curve with its value; pressing an entry hides the curve. */
export function Legend({ definition, hidden, readings, onToggle }: LegendProps) {
  const entries = definition.traces.filter((trace) => trace.follows === undefined);
  return (
    <div class="plot-head">
      <h3>
        {definition.title} <span class="unit">{definition.unit}</span>
      </h3>
      <div class="legend">
        {definition.note && <span class="legend-note">{definition.note}</span>}
        {entries.map((trace) => (
          <button
            key={trace.channel}
            type="button"
            class="legend-entry"
            aria-pressed={!hidden.has(trace.channel)}
            title={text.plots.toggle(trace.label)}
            onClick={() => onToggle(trace.channel)}
          >
            <Swatch trace={trace} />
            {trace.label}
            <output
              ref={(element) => {
                if (element) readings.current?.set(trace.channel, element);
              }}
            />
          </button>
        ))}
      </div>
    </div>
  );
}
