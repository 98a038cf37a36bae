/**
 * The plane of an arm: links, path of the tip and of its reference, live stiffness ellipse. The tip
 * is pushed by dragging it or with the arrow keys.
 */
import { useEffect, useMemo, useRef } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { type Lengths, lengthsOf, type Point, pullOf, reachOf } from "../../core/armgeometry";
import { addDrawing } from "../../core/plots/frame";
import { lineStyleOfLane } from "../../core/plots/linestyles";
import { alsoDrawn } from "../../core/plots/setups";
import { takesCommands } from "../../core/state/control";
import { armOf, configurationsOf } from "../../core/state/joints";
import { hungAtTip } from "../../core/state/plant";
import { tipPush } from "../../core/state/push";
import { samples } from "../../core/state/session";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { ArmPicture, HALF, MARGIN } from "./picture";

/** The largest force of a push relative to that which a joint can hold at the reach. */
const FORCE_SHARE = 0.5;
/** Deflection of the springs to which a push may go, rad. */
const DEFLECTION_RAD = 0.4;
/** The part of the picture above joint 1, as a share of that below: an arm hangs. */
const ABOVE = 0.3;
const ARROWS: Readonly<Record<string, Point>> = {
  ArrowLeft: { x: -1, y: 0 },
  ArrowRight: { x: 1, y: 0 },
  ArrowUp: { x: 0, y: 1 },
  ArrowDown: { x: 0, y: -1 },
};

const DRAWN = ["position_rad", "position_reference_rad", "stiffness_nm_per_rad"] as const;

const lengthsIn = (state: SessionState): Lengths => {
  const arm = armOf(state);
  return arm === null ? [1] : lengthsOf(arm.links);
};

/** Greatest stiffness of the actuators of all joints, N·m/rad. */
const mostStiffness = (state: SessionState): number =>
  Math.max(...configurationsOf(state).map(({ limits }) => limits.stiffness_max_nm_per_rad));

/** Limited by the motors, and with soft springs by their deflection. */
function mostForce(state: SessionState): number {
  const joints = configurationsOf(state);
  const stiffness = joints.map((_, joint) =>
    samples.ring.newest("stiffness_nm_per_rad", joint + 1),
  );
  const torque = Math.min(
    ...joints.map(({ limits }) => limits.torque1_nm),
    DEFLECTION_RAD * Math.min(...stiffness.filter(Number.isFinite)),
  );
  return (FORCE_SHARE * torque) / reachOf(lengthsIn(state));
}

/** A point of the pointer in the plane, m. */
function pointIn(svg: SVGSVGElement, event: PointerEvent, scale: number): Point {
  const matrix = svg.getScreenCTM();
  if (matrix === null) return { x: 0, y: 0 };
  const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
  return { x: x / scale, y: -y / scale };
}

/** A mouse pulls a tip that moves from anywhere; a finger on the rest of the picture scrolls. */
const isGrab = ({ pointerType, button, target }: PointerEvent): boolean =>
  button === 0 && (pointerType === "mouse" || (target as Element).closest("[data-tip]") !== null);

export function TipPlane({ state, note }: { state: SessionState; note?: string }) {
  const svg = useRef<SVGSVGElement>(null);
  const readout = useRef<HTMLElement>(null);
  const picture = useRef<ArmPicture | null>(null);
  const lengths = useMemo(() => lengthsIn(state), [state.configuration.arm?.links]);
  const most = mostStiffness(state);
  const looks = state.lanes
    .filter(({ joint }) => joint === 1)
    .map(({ lane, segments }) => lineStyleOfLane(segments.at(-1)?.line_style ?? 0, lane === 1));
  const walls = state.loads.flatMap(({ active, load }) =>
    active && load.kind === "wall" ? [load] : [],
  );
  const mass = hungAtTip(state);
  useEffect(() => {
    alsoDrawn.value = DRAWN;
    return () => {
      alsoDrawn.value = [];
      tipPush.release();
    };
  }, []);
  const key = JSON.stringify([looks, walls, mass, most]);
  useEffect(() => {
    if (svg.current === null || readout.current === null) return;
    const drawn = new ArmPicture(svg.current, readout.current, { lengths, most });
    picture.current = drawn;
    const drawing = addDrawing(() => drawn.draw());
    return () => drawing.remove();
  }, [lengths, key]);
  const scale = HALF / (MARGIN * reachOf(lengths));
  const push = (event: PointerEvent) => {
    const { current } = picture;
    if (svg.current === null || current === null || current.tip === null) return;
    const pointer = pointIn(svg.current, event, scale);
    const { x, y } = pullOf(lengths, current.tip, pointer, mostForce(state));
    tipPush.hold([x, y]);
    current.pointer = pointer;
  };
  const release = () => {
    tipPush.release();
    if (picture.current !== null) picture.current.pointer = null;
  };
  const pressKey = (event: KeyboardEvent) => {
    const way = ARROWS[event.key];
    if (way === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const force = 0.5 * mostForce(state);
    if (!event.repeat) tipPush.hold([force * way.x, force * way.y]);
  };
  const force = tipPush.held.value;
  return (
    <section class="surface tip-plane" aria-label={t("arm.plane")}>
      <div class="row">
        <h2>{t("arm.plane")}</h2>
        <p class="hint tabular" title={t("arm.ellipseHint")}>
          <i class="dot" style={{ background: "var(--plot-purple)" }} aria-hidden="true" />
          {t("arm.stiffness")} <strong class="number" ref={readout} />
        </p>
        <span
          class={`tip-plane-hint small tabular end ${force === null ? "muted" : "strong tone is-warn"}`}
        >
          {force === null
            ? t("arm.pushHint")
            : t("arm.pushing", { force: formatNumber(Math.hypot(...force), 2, 1) })}
        </span>
      </div>
      {note && <p class="hint">{note}</p>}
      <div class="fill">
        {/* biome-ignore lint/a11y/useSemanticElements: a picture with a part that is dragged */}
        <svg
          ref={svg}
          class="drawing fill grab"
          viewBox={`${-HALF} ${-ABOVE * HALF} ${2 * HALF} ${(1 + ABOVE) * HALF}`}
          role="group"
          aria-label={t("arm.planeLabel")}
          onPointerDown={(event) => {
            if (!takesCommands.peek() || !isGrab(event)) return;
            event.currentTarget.setPointerCapture(event.pointerId);
            push(event);
          }}
          onPointerMove={(event) => {
            if (event.currentTarget.hasPointerCapture(event.pointerId)) push(event);
          }}
          onPointerUp={release}
          onPointerCancel={release}
          onLostPointerCapture={release}
        >
          <circle class="grid" stroke-dasharray="2 6" r={scale * reachOf(lengths)} />
          <path class="grid" d={`M${-HALF} 0H${HALF}M0 ${-HALF}V${HALF}`} />
          {walls.map(({ normal_rad: normal, distance_m: distance }) => (
            <g
              key={`${normal} ${distance}`}
              transform={`rotate(${(-normal * 180) / Math.PI}) translate(${scale * distance} 0)`}
            >
              <rect
                class="tip-wall"
                x={-HALF / 6}
                y={-3 * HALF}
                width={HALF / 6}
                height={6 * HALF}
              />
            </g>
          ))}
          <path class="outline" stroke-width="2" stroke-dasharray="2 5" data-path="reference" />
          {[...looks.entries()].reverse().map(([arm, { colour, dash }]) => {
            const width = arm === 0 ? 12 : 5;
            return (
              <g key={arm} stroke-width="2.5" style={{ "--tone": `var(--plot-${colour})` }}>
                <path class="outline" data-path={arm} stroke-dasharray={dash.join(" ")} />
                <path class="outline" data-links={arm} stroke-width={width} />
              </g>
            );
          })}
          <ellipse class="tip-ellipse" data-ellipse />
          <path class="outline is-warn" stroke-width="4" stroke-dasharray="9 5" data-band />
          {mass > 0 && <path class="solid is-warn" data-mass d="M0 0V12M-9 12H9L13 30H-13Z" />}
          <circle class="tip-joint" r="6" />
          {lengths.slice(1).map((_, index) => (
            <circle key={index} class="tip-joint" data-joint={index} r="6" />
          ))}
          {/* biome-ignore lint/a11y/useSemanticElements: a part of the picture that is dragged */}
          <g
            class="tip-handle"
            data-tip
            role="button"
            aria-label={t("arm.push")}
            aria-disabled={!takesCommands.value}
            tabIndex={0}
            onKeyDown={(event) => takesCommands.peek() && pressKey(event)}
            onKeyUp={(event) => ARROWS[event.key] && release()}
            onBlur={release}
          >
            <circle class="tip-grip" r="17" />
            <circle class="solid is-warn" r="7" />
          </g>
        </svg>
      </div>
      <Problem control="tip.push" />
    </section>
  );
}
