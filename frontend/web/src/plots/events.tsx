import { useEffect, useRef, useState } from "preact/hooks";
import type { SessionEvent } from "../api/types";
import { session } from "../state/session";
import { text } from "../text/en";
import { closeOnEscape } from "../widgets/escape";
import { isLoad } from "./eventlines";
import { onFrame, shareOf } from "./frame";
import { shownRing } from "./span";
import { StepNumbers } from "./stepnumbers";

const LABEL_GAP_PX = 6;

interface MarkProps {
  event: SessionEvent;
  /** When the next event comes, s. */
  nextS: number;
}

/** One event: its name where there is room, and what it did, on hover or focus. */
function Mark({ event, nextS }: MarkProps) {
  const [isOpen, setOpen] = useState(false);
  useEffect(() => (isOpen ? closeOnEscape(() => setOpen(false)) : undefined), [isOpen]);
  return (
    <li
      class={`mark ${isLoad(event) ? "is-load" : ""}`}
      data-time={event.time_s}
      onMouseEnter={() => setOpen(true)}
      onMouseLeave={() => setOpen(false)}
    >
      <button
        type="button"
        aria-label={text.steps.mark(event.label, event.time_s.toFixed(2))}
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

/** Puts the marks in their places; a label is shown where it fits, a load's and a newer one's first. */
function place(list: HTMLElement): void {
  const width = list.clientWidth;
  const marks = [...list.querySelectorAll<HTMLElement>(":scope > .mark")];
  const seen = marks.filter((mark) => {
    const share = shareOf(Number(mark.dataset.time));
    mark.hidden = share < 0 || share > 1;
    mark.style.left = `${share * width}px`;
    return !mark.hidden;
  });
  const newestFirst = [...seen].reverse();
  const isLoadMark = (mark: HTMLElement) => mark.classList.contains("is-load");
  const order = [
    ...newestFirst.filter(isLoadMark),
    ...newestFirst.filter((mark) => !isLoadMark(mark)),
  ];
  const taken: [number, number][] = seen.map((mark) => {
    const x = Number.parseFloat(mark.style.left);
    return [x - 6, x + 6];
  });
  for (const mark of order) {
    const label = mark.querySelector<HTMLElement>(".mark-label");
    if (label === null) continue;
    mark.dataset.width ??= String(label.scrollWidth);
    const room = Number(mark.dataset.width) + LABEL_GAP_PX;
    const x = Number.parseFloat(mark.style.left);
    const isRight = x + 8 + room <= width;
    const from = isRight ? x + 7 : x - 7 - room;
    const to = from + room;
    const isFree = from >= -50 && taken.every(([left, right]) => to <= left || from >= right);
    mark.classList.toggle("is-left", !isRight);
    mark.classList.toggle("is-named", isFree);
    if (isFree) taken.push([from, to]);
  }
}

/** The events whose samples are there to look at. */
function keptEvents(): SessionEvent[] {
  const oldest = shownRing().oldestTime;
  return (session.value?.events ?? []).filter((event) => !(event.time_s < oldest));
}

/** A key for each event, also for two of one kind at one tick, as while a session is paused. */
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
  const events = keptEvents();
  const keys = keysOf(events);
  useEffect(() => {
    const put = () => list.current && place(list.current);
    put();
    const stop = onFrame(put);
    return stop;
  }, []);
  return (
    <ul class="marks" ref={list} aria-label={text.plots.events}>
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
