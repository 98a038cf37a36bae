import { signal } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { mayCommand } from "../../core/state/control";

import { session } from "../../core/state/session";
import { readStored, store } from "../../core/stored";
import { t } from "../../core/text/t";
import { closeOnEscape } from "../../core/widgets/panel";
import { restoreTo } from "../../lab/design/history";
import { hasWebGl } from "../../lab/scene/schematic";

const STORE = "svsa.tour";
const GAP_PX = 12;

/** Each step and the part of the page that it describes; the first has none. */
const STEPS = [
  { key: "welcome", target: ".view" },
  { key: "view", target: ".view" },
  { key: "plots", target: "#plots" },
  { key: "load", target: ".load-button" },
  { key: "controller", target: ".compare" },
  { key: "all", target: ".all-controls" },
] as const;

/** The step shown; null without a tour. */
const step = signal<number | null>(readStored(STORE) === "done" ? null : 0);

export function startTour(): void {
  step.value = 0;
  go(1);
}

/** State before the tour, which is restored at its end. */
let before: SessionState | null = null;

function endTour(): void {
  step.value = null;
  if (before !== null && mayCommand.peek()) void restoreTo(before);
  before = null;
  store(STORE, "done");
  // The next Tab goes to the load button, not to the top of the page.
  document.querySelector<HTMLElement>(".load-place")?.focus({ preventScroll: true });
}

function go(by: number): void {
  const next = (step.peek() ?? 0) + by;
  if (before === null) before = session.peek();
  if (next >= STEPS.length) endTour();
  else step.value = Math.max(0, next);
}

interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

const clamp = (value: number, most: number) => Math.max(GAP_PX, Math.min(value, most));

/** Next to the part it describes, if there is room; the first below the 3D view. */
function place(card: HTMLElement, target: Box, isFirst: boolean): void {
  const { offsetWidth: width, offsetHeight: height } = card;
  const mostX = window.innerWidth - width - GAP_PX;
  const mostY = window.innerHeight - height - GAP_PX;
  const right = target.left + target.width + GAP_PX;
  let x = target.left + GAP_PX;
  let y = target.top + target.height - height - GAP_PX;
  if (!isFirst && right <= mostX) [x, y] = [right, target.top];
  else if (!isFirst && target.left - width - GAP_PX >= GAP_PX) {
    [x, y] = [target.left - width - GAP_PX, target.top];
  } else if (!isFirst) y = target.top + target.height + GAP_PX;
  card.style.left = `${clamp(x, mostX)}px`;
  card.style.top = `${clamp(y, mostY)}px`;
}

/** Position of the target, updated when the window changes. */
function useTargetBox(selector: string, isShown: boolean): Box | null {
  const [box, setBox] = useState<Box | null>(null);
  useLayoutEffect(() => {
    const target = document.querySelector(selector);
    if (target === null) return;
    if (isShown) target.scrollIntoView({ block: "nearest" });
    const look = () => setBox(target.getBoundingClientRect());
    look();
    const watching = new ResizeObserver(look);
    watching.observe(target);
    watching.observe(document.body);
    window.addEventListener("scroll", look, true);
    return () => {
      watching.disconnect();
      window.removeEventListener("scroll", look, true);
    };
  }, [selector, isShown]);
  return box;
}

function Card({ index }: { index: number }) {
  const { key, target } = STEPS[index] as (typeof STEPS)[number];
  const texts = key === "view" && !hasWebGl ? "tour.viewIn2d" : (`tour.steps.${key}` as const);
  const isFirst = index === 0;
  const isLast = index === STEPS.length - 1;
  const card = useRef<HTMLElement>(null);
  const onward = useRef<HTMLButtonElement>(null);
  const box = useTargetBox(target, !isFirst);
  useLayoutEffect(() => {
    if (card.current && box) place(card.current, box, isFirst);
  }, [box, isFirst]);
  useEffect(() => {
    if (!isFirst) onward.current?.focus({ preventScroll: true });
  }, [index, isFirst]);
  useLayoutEffect(() => closeOnEscape(endTour), []);
  const turn = (event: KeyboardEvent) => {
    if (event.key === "ArrowRight") go(1);
    if (event.key === "ArrowLeft") go(-1);
  };
  return (
    <>
      {box && !isFirst && (
        <div
          class="tour-ring"
          style={{
            left: `${box.left}px`,
            top: `${box.top}px`,
            width: `${box.width}px`,
            height: `${box.height}px`,
          }}
        />
      )}
      <section ref={card} class="floating stack tour" aria-label={t("tour.label")} onKeyDown={turn}>
        <p class="hint tour-count">{t("tour.of", { step: index + 1, all: STEPS.length })}</p>
        <h2>{t(`${texts}.title`)}</h2>
        <div aria-live="polite">
          <p translate>{t(`${texts}.words`)}</p>
        </div>
        <div class="row">
          <button type="button" class="quiet start" onClick={endTour} title={t("tour.keys")}>
            {t("tour.skip")}
          </button>
          {index > 1 && (
            <button type="button" class="button" onClick={() => go(-1)}>
              {t("tour.back")}
            </button>
          )}
          <button ref={onward} type="button" class="button is-primary" onClick={() => go(1)}>
            {isFirst ? t("tour.take") : isLast ? t("tour.done") : t("tour.next")}
          </button>
        </div>
      </section>
    </>
  );
}

/** The tour: offered on the first visit, later only on request. */
export function Tour() {
  return step.value === null ? null : <Card index={step.value} />;
}
