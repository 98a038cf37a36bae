import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { samples } from "../../core/state/session";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { closeOnEscape } from "../../core/widgets/panel";
import { heldTorque, keepPush } from "./hold";
import { angleSeen, pullOf } from "./ray";
import { cameraNow } from "./viewer";

export const isPushing = signal(false);

const KEY_NM = 1;

interface Grip {
  x: number;
  y: number;
  /** Angle of the pointer against the link when it was taken. */
  taken: number;
}

const linkAngle = () => samples.ring.newest("position_rad");
const pull = signal<{ from: Grip; x: number; y: number; torque: number } | null>(null);

function holdAt(torque: number): void {
  heldTorque.value = torque;
  void keepPush();
}

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
    <svg class="push-band" aria-hidden="true">
      <line x1={now.from.x} y1={now.from.y} x2={now.x} y2={now.y} />
      <circle cx={now.from.x} cy={now.from.y} r="5" />
      <text x={now.x + 14} y={now.y - 10}>
        {text.scene.pulling(formatNumber(now.torque, 2, 1))}
      </text>
    </svg>
  );
}

const torqueOf = ({ key }: KeyboardEvent): number | undefined =>
  ({ ArrowLeft: -KEY_NM, ArrowRight: KEY_NM })[key];

function release(): void {
  pull.value = null;
  heldTorque.value = null;
}

/** Lies over the 3D view while the link may be taken: a drag is a spring that pulls at it. */
export function PushLayer() {
  const layer = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    layer.current?.focus({ preventScroll: true });
    const forget = closeOnEscape(() => {
      isPushing.value = false;
    });
    return () => {
      forget();
      release();
    };
  }, []);
  const follow = (event: PointerEvent, from: Grip) => {
    const host = layer.current as HTMLElement;
    const angle = pointerAngle(host, event);
    if (angle === null) return;
    const box = host.getBoundingClientRect();
    const torque = pullOf(angle, linkAngle(), from.taken);
    pull.value = { from, x: event.clientX - box.left, y: event.clientY - box.top, torque };
    holdAt(torque);
  };
  const take = (event: PointerEvent) => {
    const host = layer.current as HTMLElement;
    const angle = pointerAngle(host, event);
    if (angle === null) return;
    host.setPointerCapture(event.pointerId);
    const box = host.getBoundingClientRect();
    follow(event, {
      x: event.clientX - box.left,
      y: event.clientY - box.top,
      taken: angle - linkAngle(),
    });
  };
  const answer = (event: KeyboardEvent) => {
    const torque = torqueOf(event);
    if (torque === undefined) return;
    if (!event.repeat) holdAt(torque);
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <>
      <button
        ref={layer}
        type="button"
        class="push-layer"
        aria-label={text.scene.pushLayer}
        onPointerDown={take}
        onPointerMove={(event) => {
          const from = pull.peek()?.from;
          if (from) follow(event, from);
        }}
        onPointerUp={release}
        onPointerCancel={release}
        onKeyDown={answer}
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
