/** The actuator in 2D, from the samples of the stream, for browsers that cannot draw it in 3D. */
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { lineStyleOfLane } from "../../core/plots/linestyles";
import { alsoDrawn } from "../../core/plots/setups";
import { receivedCount, samples } from "../../core/state/session";
import { t } from "../../core/text/t";
import { toDegrees } from "../../core/units";

/** Front view: at 0 the link hangs straight down, and a positive angle turns it to the right. */
const turnOf = (rad: number): string => `rotate(${-toDegrees(rad)})`;

const LEAST_NM = 0.05;
const MOST_NM = 20;
const LONGEST_RAD = 3.6;

/**
 * An arrow about the axis, with the length of the 3D view: proportional to the square root of the
 * torque; counter-clockwise if positive.
 */
function arrowOf(torqueNm: number, radius: number): string {
  const size = Math.min(Math.abs(torqueNm), MOST_NM);
  if (!(size >= LEAST_NM)) return "";
  const [least, most] = [Math.sqrt(LEAST_NM), Math.sqrt(MOST_NM)];
  const length = 0.45 + ((Math.sqrt(size) - least) / (most - least)) * (LONGEST_RAD - 0.45);
  const way = Math.sign(torqueNm);
  const at = (angle: number, r: number) =>
    `${(-way * r * Math.sin(angle)).toFixed(1)} ${(-r * Math.cos(angle)).toFixed(1)}`;
  const arc = `A${radius} ${radius} 0 ${length > Math.PI ? 1 : 0} ${way > 0 ? 0 : 1} `;
  const barb = length - 9 / radius;
  return `M${at(0, radius)}${arc}${at(length, radius)}L${at(barb, radius - 6)}M${at(length, radius)}L${at(barb, radius + 6)}`;
}

const LINK_RADIUS = 74;
const TORQUES = ["disturbance_link_nm", "disturbance_motor1_nm", "disturbance_motor2_nm"] as const;

/** A disturbance torque: drawn at the arm of the link, or at the top of a motor. */
const Torque = ({ of, radius }: { of: (typeof TORQUES)[number]; radius: number }) => (
  <path class="outline is-warn" data-torque={of} data-radius={radius}>
    <title>{t(`channelNames.${of}`)}</title>
  </path>
);

/** Whether the browser supports WebGL: without it the 3D view stays empty. */
export const hasWebGl = ((): boolean => {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return context !== null;
})();

/** Moving elements, by `data-channel` and `data-lane`; hidden while they have no sample. */
function keepPoses(picture: SVGSVGElement): () => void {
  return effect(() => {
    void receivedCount.value;
    for (const part of picture.querySelectorAll<SVGPathElement>("[data-torque]")) {
      const { torque = "", radius } = part.dataset;
      part.setAttribute("d", arrowOf(samples.ring.newest(torque, 1), Number(radius)));
    }
    for (const part of picture.querySelectorAll<SVGGElement>("[data-channel]")) {
      const { channel = "", lane } = part.dataset;
      const angle = samples.ring.newest(channel, Number(lane));
      part.style.visibility = Number.isNaN(angle) ? "hidden" : "visible";
      if (!Number.isNaN(angle)) part.setAttribute("transform", turnOf(angle));
    }
  });
}

/** Links of all lanes, the reference, the hanging mass and the torques, as in 3D. */
export function Schematic({ state }: { state: SessionState }) {
  const picture = useRef<SVGSVGElement>(null);
  useEffect(() => {
    alsoDrawn.value = TORQUES;
    return picture.current === null ? undefined : keepPoses(picture.current);
  }, []);
  const isHung = state.loads.some(({ active, load }) => active && load.kind === "mass");
  return (
    <figure class="column schematic">
      <svg ref={picture} viewBox="-120 -120 240 240" role="img" aria-label={t("scene.schematic")}>
        <circle class="schematic-body" r="46" />
        <g data-channel="position_reference_rad" data-lane="1">
          <path class="outline" stroke-dasharray="1 6" d="M0 46V104" />
        </g>
        {[...state.lanes].reverse().map(({ lane, segments }) => {
          const { colour } = lineStyleOfLane(segments.at(-1)?.line_style ?? 0, lane === 1);
          return (
            <g key={lane} data-channel="position_rad" data-lane={lane}>
              <path
                class="outline"
                style={{ "--tone": `var(--plot-${colour})`, strokeWidth: lane === 1 ? 10 : 5 }}
                d="M0 0V92"
              />
              {lane === 1 && (
                <g transform="rotate(180)">
                  <Torque of="disturbance_link_nm" radius={LINK_RADIUS} />
                </g>
              )}
              {lane === 1 && isHung && (
                <circle class="solid is-warn schematic-load" cy="98" r="12" />
              )}
            </g>
          );
        })}
        <Torque of="disturbance_motor1_nm" radius={58} />
        <Torque of="disturbance_motor2_nm" radius={32} />
        <circle class="solid" r="6" />
      </svg>
      <figcaption class="hint">{t("scene.noWebGl")}</figcaption>
    </figure>
  );
}
