import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { SessionEvent } from "../api/types";
import { controllerAt, laneSegments } from "../state/lanes";
import { session } from "../state/session";
import { t } from "../text/t";
import { formatFixed, formatNumber, toDegrees } from "../units";
import { Swatch } from "./legend";
import { lineStyleOfLane } from "./linestyles";
import { shownLaneSegments, shownRing } from "./span";
import { findStep } from "./stepmetrics";

const AGAIN_MS = 500;

const degrees = (rad: number) => formatNumber(toDegrees(rad), 3, 3);

interface StepNumbersProps {
  event: SessionEvent;
  /** Time of the next event, s. */
  nextS: number;
}

/** Effect of an event on the position of each lane, up to the next event. */
export function StepNumbers({ event, nextS }: StepNumbersProps) {
  const [, setCount] = useState(0);
  const panel = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const timer = setInterval(() => setCount((count) => count + 1), AGAIN_MS);
    return () => clearInterval(timer);
  }, []);
  useLayoutEffect(() => {
    const element = panel.current;
    const list = element?.closest(".marks");
    if (!element || !list) return;
    element.style.marginLeft = "0";
    const { left, right } = element.getBoundingClientRect();
    const room = list.getBoundingClientRect();
    const shift = Math.min(0, room.right - right) + Math.max(0, room.left - left);
    element.style.marginLeft = `${shift}px`;
  });
  const state = session.value;
  if (state === null) return null;
  const shown = shownLaneSegments.value;
  const of = { ring: shownRing(), shown, present: laneSegments.value };
  const { untilS, read } = findStep(state, event, nextS, of);
  const rows = shown.flatMap((segments, index) => {
    const controller = controllerAt(segments, event.time_s);
    const metrics = read(index);
    return controller === undefined ? [] : [{ ...controller, lane: index + 1, metrics }];
  });
  const chosen = shown[0]?.at(-1)?.number;
  const isHeld = rows.some(({ metrics }) => metrics !== null);
  const missingS = Math.max(0, ...rows.map(({ metrics }) => metrics?.missingS ?? 0));
  return (
    <div class="floating small step-numbers" ref={panel} role="status">
      <strong>
        {t("steps.heading", { event: event.label, time: formatFixed(event.time_s, 2) })}
      </strong>
      {isHeld ? (
        <table class="metrics">
          <caption>
            {Number.isFinite(untilS)
              ? t("steps.until", { time: formatFixed(untilS, 2) })
              : t("steps.untilNow")}
          </caption>
          <thead>
            <tr>
              <th scope="col">{t("steps.lane")}</th>
              <th scope="col">
                {t("steps.peak")} <span class="unit">{t("compare.degrees")}</span>
              </th>
              <th scope="col">
                {t("steps.rms")} <span class="unit">{t("compare.degrees")}</span>
              </th>
              <th scope="col">
                {t("steps.recovery")} <span class="unit">{t("compare.seconds")}</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {rows.map(({ name, number, lineStyle, lane, metrics }) => (
              <tr key={lane}>
                <th scope="row">
                  <Swatch look={lineStyleOfLane(lineStyle, number === chosen)} />
                  {name}
                </th>
                <td>{degrees(metrics?.peak ?? Number.NaN)}</td>
                <td>{degrees(metrics?.rms ?? Number.NaN)}</td>
                <td>
                  {metrics?.recoveryS === null
                    ? t("steps.notYet")
                    : formatNumber(metrics?.recoveryS, 3, 2)}
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      ) : (
        <p>{t("steps.gone")}</p>
      )}
      {missingS > 0 && (
        <p class="hint">{t("steps.missing", { seconds: formatNumber(missingS, 3, 2) })}</p>
      )}
    </div>
  );
}
