/** The actuator in 2D, from the samples of the stream, where the browser cannot draw it in 3D. */
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { lineStyleOfLane } from "../../core/plots/linestyles";
import { hungWeights } from "../../core/state/plant";
import { received, samples } from "../../core/state/session";
import { text } from "../../core/text/en";
import { toDegrees } from "../../core/units";

const words = text.scene;

/** Seen from the front: at 0 the link hangs straight down, and a positive angle turns it to the right. */
const turnOf = (rad: number): string => `rotate(${-toDegrees(rad)})`;

/** Whether the browser draws WebGL at all: without it the 3D view stays empty. */
export const hasWebGl = ((): boolean => {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return context !== null;
})();

/** What turns, by `data-channel` and `data-lane`; hidden while there is no sample of it. */
function keepPoses(picture: SVGSVGElement): () => void {
  return effect(() => {
    void received.value;
    for (const part of picture.querySelectorAll<SVGGElement>("[data-channel]")) {
      const { channel = "", lane } = part.dataset;
      const angle = samples.ring.newest(channel, Number(lane));
      part.style.visibility = Number.isNaN(angle) ? "hidden" : "visible";
      if (!Number.isNaN(angle)) part.setAttribute("transform", turnOf(angle));
    }
  });
}

/** Links of all lanes, the reference, and the load that hangs; the same poses as in 3D. */
export function Schematic({ state }: { state: SessionState }) {
  const picture = useRef<SVGSVGElement>(null);
  useEffect(() => (picture.current === null ? undefined : keepPoses(picture.current)), []);
  const isHung = hungWeights(state).length > 0;
  return (
    <figure class="schematic">
      <svg ref={picture} viewBox="-120 -120 240 240" role="img" aria-label={words.schematic}>
        <circle class="schematic-body" r="46" />
        <g data-channel="position_reference_rad" data-lane="1">
          <path class="schematic-reference" d="M0 46V104" />
        </g>
        {[...state.lanes].reverse().map(({ lane, segments }) => {
          const { colour } = lineStyleOfLane(segments.at(-1)?.line_style ?? 0, lane === 1);
          return (
            <g key={lane} data-channel="position_rad" data-lane={lane}>
              <path
                class={lane === 1 ? "schematic-link is-own" : "schematic-link"}
                style={{ stroke: `var(--plot-${colour})` }}
                d="M0 0V92"
              />
              {lane === 1 && isHung && <circle class="schematic-load" cy="98" r="12" />}
            </g>
          );
        })}
        <circle class="schematic-axis" r="6" />
      </svg>
      <figcaption class="hint">{words.noWebGl}</figcaption>
    </figure>
  );
}
