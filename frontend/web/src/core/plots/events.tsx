import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { SessionEvent } from "../api/types";
import { selectionCount, session } from "../state/session";
import { t } from "../text/t";
import { formatFixed } from "../units";
import { closeOnEscape } from "../widgets/panel";
import { isLoad, nameMarks, type PlacedMark, rankOf } from "./eventlines";
import { onFrame, shareOf } from "./frame";
import { shownRing } from "./span";
import { StepNumbers } from "./stepnumbers";

const LABEL_GAP_PX = 6;
/** A fault comes one tick after the last sample: the view must include it. */
const PAST_THE_END = 0.005;

interface MarkProps {
  event: SessionEvent;
  /** Time of the next event, s. */
  nextS: number;
}

/** One event: its label if there is space, and its description on hover or focus. */
function Mark({ event, nextS }: MarkProps) {
  const [isOpen, setOpen] = useState(false);
  useLayoutEffect(() => (isOpen ? closeOnEscape(() => setOpen(false)) : undefined), [isOpen]);
  return (
    <li
      class={`mark ${isLoad(event) ? "is-load" : ""} ${event.kind === "fault" ? "is-fault" : ""}`}
      data-time={event.time_s}
      data-kind={event.kind}
      onMouseEnter={() => setOpen(true)}
      onMouseLeave={() => setOpen(false)}
    >
      <button
        type="button"
        class="line tight tiny strong nowrap"
        aria-label={t("steps.mark", { event: event.label, time: formatFixed(event.time_s, 2) })}
        aria-expanded={isOpen}
        onFocus={() => setOpen(true)}
        onBlur={() => setOpen(false)}
        onClick={() => setOpen(true)}
      >
        <svg viewBox="0 0 10 10" aria-hidden="true">
          <path d={isLoad(event) ? "M0 1h10L5 10z" : "M5 0l5 5-5 5-5-5z"} />
        </svg>
        <span class="mark-label">{event.label}</span>
      </button>
      {isOpen && <StepNumbers event={event} nextS={nextS} />}
    </li>
  );
}

/** Place the marks, with labels where they fit. */
function place(list: HTMLElement): void {
  const width = list.clientWidth;
  const seen = [...list.querySelectorAll<HTMLElement>(":scope > .mark")].filter((mark) => {
    const share = shareOf(Number(mark.dataset.time));
    mark.hidden = share < 0 || share > 1 + PAST_THE_END;
    mark.style.left = `${Math.min(share, 1) * width}px`;
    return !mark.hidden;
  });
  const sides = nameMarks(seen.map(measure), width);
  seen.forEach((mark, index) => {
    mark.classList.toggle("is-left", sides[index] === "left");
    mark.classList.toggle("is-named", sides[index] !== null);
  });
}

function measure(mark: HTMLElement): PlacedMark {
  mark.dataset.width ??= String(mark.querySelector(".mark-label")?.scrollWidth ?? 0);
  return {
    x: Number.parseFloat(mark.style.left),
    room: Number(mark.dataset.width) + LABEL_GAP_PX,
    rank: rankOf(mark.dataset.kind ?? ""),
  };
}

/** The events whose samples are stored. */
function eventsInView(): SessionEvent[] {
  void selectionCount.value;
  const oldest = shownRing().oldestTime;
  return (session.value?.events ?? []).filter((event) => !(event.time_s < oldest));
}

/** A key for each event, unique also for two events of one kind in one tick (paused session). */
function keysOf(events: readonly SessionEvent[]): string[] {
  const seen = new Map<string, number>();
  return events.map(({ tick, kind, label }) => {
    const name = `${tick}.${kind}.${label}`;
    const count = seen.get(name) ?? 0;
    seen.set(name, count + 1);
    return `${name}.${count}`;
  });
}

/** The events in view, above the plots. */
export function EventMarks() {
  const list = useRef<HTMLUListElement>(null);
  const events = eventsInView();
  const keys = keysOf(events);
  useEffect(() => {
    const put = () => list.current && place(list.current);
    const stop = onFrame(put);
    const resizing = new ResizeObserver(put);
    if (list.current) resizing.observe(list.current);
    return () => {
      stop();
      resizing.disconnect();
    };
  }, []);
  return (
    <ul class="marks" ref={list} aria-label={t("plots.events")}>
      {events.map((event, index) => (
        <Mark
          key={keys[index]}
          event={event}
          nextS={
            events.slice(index + 1).find(({ time_s }) => time_s > event.time_s)?.time_s ?? Infinity
          }
        />
      ))}
    </ul>
  );
}
