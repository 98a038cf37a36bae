import type { RefObject } from "preact";
import { t } from "../text/t";
import { formatFixed } from "../units";
import { CURSOR_NAMES, type CursorName, cursors, moveCursor, stepCursor } from "./cursors";
import { shareAt } from "./gestures";
import { frozen } from "./span";

const LARGE_STEP = 20;

const STEPS: Readonly<Record<string, number>> = {
  ArrowLeft: -1,
  ArrowDown: -1,
  ArrowRight: 1,
  ArrowUp: 1,
  PageDown: -LARGE_STEP,
  PageUp: LARGE_STEP,
};

interface CursorProps {
  name: CursorName;
  box: RefObject<HTMLElement | null>;
}

function useDrag(name: CursorName, box: RefObject<HTMLElement | null>) {
  return {
    onPointerDown: (event: PointerEvent) => {
      (event.currentTarget as Element).setPointerCapture(event.pointerId);
      event.stopPropagation();
    },
    onPointerMove: (event: PointerEvent) => {
      const span = frozen.peek();
      const element = event.currentTarget as Element;
      if (!element.hasPointerCapture(event.pointerId) || box.current === null || !span) return;
      const share = Math.min(1, Math.max(0, shareAt(box.current, event.clientX)));
      moveCursor(name, span.from + share * (span.to - span.from));
    },
  };
}

function usePlace(name: CursorName): { share: number; time: number } | null {
  const span = frozen.value;
  const time = cursors.value?.[name];
  if (span === null || time === undefined) return null;
  const share = (time - span.from) / (span.to - span.from);
  return { share, time };
}

/** The line of a cursor over all plots; it can be dragged at any height. */
function Line({ name, box }: CursorProps) {
  const drag = useDrag(name, box);
  const place = usePlace(name);
  if (place === null || place.share < 0 || place.share > 1) return null;
  return (
    <div class={`cursor-line is-${name}`} style={{ left: `${place.share * 100}%` }} {...drag} />
  );
}

/**
 * The label at the foot of a cursor, which has the keyboard focus. Outside the axis it is shown at
 * the axis' end.
 */
function Handle({ name, box }: CursorProps) {
  const drag = useDrag(name, box);
  const place = usePlace(name);
  const ring = frozen.value?.ring;
  if (place === null || ring === undefined) return null;
  const share = Math.min(1, Math.max(0, place.share));
  return (
    <div
      class={`small strong cursor-handle is-${name}`}
      style={{ left: `${share * 100}%` }}
      role="slider"
      tabIndex={0}
      aria-label={t("cursors.handle", { name: t(`cursors.names.${name}`) })}
      aria-valuemin={ring.oldestTime}
      aria-valuemax={ring.newestTime}
      aria-valuenow={place.time}
      aria-valuetext={t("cursors.value", { time: formatFixed(place.time, 3) })}
      title={t("cursors.keys")}
      onKeyDown={(event) => {
        const step = STEPS[event.key];
        if (step === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        stepCursor(name, event.shiftKey ? step * LARGE_STEP : step);
      }}
      {...drag}
    >
      {t(`cursors.names.${name}`)}
    </div>
  );
}

export function CursorLines({ box }: { box: RefObject<HTMLElement | null> }) {
  return CURSOR_NAMES.map((name) => <Line key={name} name={name} box={box} />);
}

export function CursorHandles({ box }: { box: RefObject<HTMLElement | null> }) {
  return CURSOR_NAMES.map((name) => <Handle key={name} name={name} box={box} />);
}
