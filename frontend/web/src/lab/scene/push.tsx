import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { linkPush } from "../../core/state/push";
import { samples } from "../../core/state/session";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { closeOnEscape } from "../../core/widgets/panel";
import { angleSeen, pullOf } from "./ray";
import { cameraNow } from "./viewer";

export const isPushing = signal(false);

const KEY_NM = 1;

interface GrabPoint {
  x: number;
  y: number;
  /** Angle between pointer and link when it was grabbed. */
  angleOffset: number;
}

const linkAngle = () => samples.ring.newest("position_rad");
const pull = signal<{ from: GrabPoint; x: number; y: number; torque: number } | null>(null);

function pointerAngle(layer: HTMLElement, event: { clientX: number; clientY: number }) {
  const box = layer.getBoundingClientRect();
  const camera = cameraNow();
  if (camera === null) return null;
  const right = ((event.clientX - box.left) / box.width) * 2 - 1;
  const up = 1 - ((event.clientY - box.top) / box.height) * 2;
  return angleSeen(camera, right, up);
}

function Band() {
  const now = pull.value;
  if (now === null) return null;
  return (
    <svg class="drawing fill push-band" aria-hidden="true">
      <line
        class="outline is-warn"
        stroke-width="3"
        stroke-dasharray="7 3"
        x1={now.from.x}
        y1={now.from.y}
        x2={now.x}
        y2={now.y}
      />
      <circle class="solid is-warn" cx={now.from.x} cy={now.from.y} r="5" />
      <text x={now.x + 14} y={now.y - 10}>
        {t("scene.pulling", { torque: formatNumber(now.torque, 2, 1) })}
      </text>
    </svg>
  );
}

const torqueOf = ({ key }: KeyboardEvent): number | undefined =>
  ({ ArrowLeft: -KEY_NM, ArrowRight: KEY_NM })[key];

function release(): void {
  pull.value = null;
  linkPush.release();
}

/** An overlay on the 3D view while the link can be grabbed: a drag acts as a spring on the link. */
export function PushLayer() {
  const layer = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    layer.current?.focus({ preventScroll: true });
    const removeEscape = closeOnEscape(() => {
      isPushing.value = false;
    });
    return () => {
      removeEscape();
      release();
    };
  }, []);
  const updatePull = (event: PointerEvent, from: GrabPoint) => {
    const host = layer.current as HTMLElement;
    const angle = pointerAngle(host, event);
    if (angle === null) return;
    const box = host.getBoundingClientRect();
    const torque = pullOf(angle, linkAngle(), from.angleOffset);
    pull.value = { from, x: event.clientX - box.left, y: event.clientY - box.top, torque };
    linkPush.hold([torque]);
  };
  const startPull = (event: PointerEvent) => {
    const host = layer.current as HTMLElement;
    const angle = pointerAngle(host, event);
    if (angle === null) return;
    host.setPointerCapture(event.pointerId);
    const box = host.getBoundingClientRect();
    updatePull(event, {
      x: event.clientX - box.left,
      y: event.clientY - box.top,
      angleOffset: angle - linkAngle(),
    });
  };
  const pressKey = (event: KeyboardEvent) => {
    const torque = torqueOf(event);
    if (torque === undefined) return;
    if (!event.repeat) linkPush.hold([torque]);
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <>
      <button
        ref={layer}
        type="button"
        class="fill grab push-layer"
        aria-label={t("scene.pushLayer")}
        onPointerDown={startPull}
        onPointerMove={(event) => {
          const from = pull.peek()?.from;
          if (from) updatePull(event, from);
        }}
        onPointerUp={release}
        onPointerCancel={release}
        onKeyDown={pressKey}
        onKeyUp={(event) => {
          if (torqueOf(event) !== undefined) release();
        }}
        onBlur={release}
      />
      <Band />
      <div class="push-problem">
        <Problem control="scene.push" />
      </div>
    </>
  );
}
