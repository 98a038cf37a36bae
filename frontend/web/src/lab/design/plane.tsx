import { useRef } from "preact/hooks";
import { t } from "../../core/text/t";
import { type Draft, designInUse, draft, type Group, setDraftPoles } from "./draft";
import {
  countPlaces,
  MAX_IM,
  MAX_RE,
  MIN_RE,
  movePole,
  type Pole,
  type Poles,
  stepPole,
} from "./poles";
import { stability } from "./stability";
import { describePole } from "./words";

const SCALE = 1.1;
const WIDTH = (MAX_RE - MIN_RE) * SCALE;
const HEIGHT = 2 * MAX_IM * SCALE;
const CIRCLES = [50, 100, 150, 200, 250];
const FAR = 10;
const GROUPS: readonly Group[] = ["position", "stiffness"];
const MARKS: Record<Group, string> = {
  position: "M-6-6L6 6M-6 6L6-6",
  stiffness: "M0-8L8 0 0 8-8 0z",
};
const ARROWS: Record<string, readonly [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

const xOf = (re: number) => (Math.max(MIN_RE, Math.min(MAX_RE, re)) - MIN_RE) * SCALE;
const yOf = (im: number) => (MAX_IM - Math.max(-MAX_IM, Math.min(MAX_IM, im))) * SCALE;

/** Axes, circles of equal natural frequency, and the unstable half. */
function Ground() {
  const x0 = xOf(0);
  const y0 = yOf(0);
  return (
    <svg aria-hidden="true">
      <defs>
        <pattern id="unstable-half" width="8" height="8" patternUnits="userSpaceOnUse">
          <path d="M-2 10L10-2M-2 2L2-2M6 10L10 6" class="outline is-bad" opacity="0.25" />
        </pattern>
        <clipPath id="stable-half">
          <rect x="0" y="0" width={x0} height={HEIGHT} />
        </clipPath>
      </defs>
      <rect class="plane-unstable" x={x0} y="0" width={WIDTH - x0} height={HEIGHT} />
      <rect x={x0} y="0" width={WIDTH - x0} height={HEIGHT} fill="url(#unstable-half)" />
      <g clip-path="url(#stable-half)">
        {CIRCLES.map((speed) => (
          <circle key={speed} class="grid" cx={x0} cy={y0} r={speed * SCALE} />
        ))}
      </g>
      <path class="outline" opacity="0.5" d={`M0 ${y0}H${WIDTH}M${x0} 0V${HEIGHT}`} />
      {CIRCLES.map((speed) => (
        <text key={speed} x={xOf(-speed)} y={HEIGHT - 6} text-anchor="middle">
          {`\u2212${speed}`}
        </text>
      ))}
      <text x={WIDTH - 4} y={y0 - 6} text-anchor="end">
        {t("design.real")}
      </text>
      <text x={x0 + 5} y="13">
        {t("design.imaginary")}
      </text>
      <text class="strong" x="8" y="15">
        {t("design.stable")}
      </text>
      <text class="tone is-bad" x={WIDTH - 2} y={HEIGHT - 6} text-anchor="end">
        {t("design.unstable")}
      </text>
    </svg>
  );
}

function ObserverMark({ bandwidth }: { bandwidth: number }) {
  const x = xOf(-bandwidth);
  return (
    <svg class="is-observer" aria-hidden="true">
      <path
        class="outline"
        stroke-width="2"
        stroke-dasharray="3 3"
        d={`M${x} ${yOf(20)}V${yOf(-20)}`}
      />
      <text class="tone" x={x} y={yOf(20) - 4} text-anchor="middle">
        {t("design.observerLine")}
      </text>
    </svg>
  );
}

/** Limit of the observer's bandwidth for stability of the sampled loop. */
function FastestMark() {
  const fastest = stability.value?.fastest_observer_rad_per_s ?? null;
  if (fastest === null || -fastest < MIN_RE) return null;
  const x = xOf(-fastest);
  return (
    <svg class="is-observer" aria-hidden="true">
      <rect class="solid" opacity="0.09" x="0" y="0" width={x} height={HEIGHT} />
      <path class="outline" stroke-width="1.5" d={`M${x} 0V${HEIGHT}`} />
      <text class="tone" x={x + 5} y={HEIGHT - 22}>
        {t("stability.fastestLine", { value: fastest.toFixed(0) })}
      </text>
    </svg>
  );
}

interface PoleMarkProps {
  group: Group;
  poles: Poles;
  index: number;
  readPlace: (event: PointerEvent) => Pole;
}

/** A pole to drag, or to move with the arrow keys. */
function PoleMark({ group, poles, index, readPlace }: PoleMarkProps) {
  const start = useRef<Poles | null>(null);
  const pole = poles[index] as Pole;
  const name = t(`design.${group}`);
  const grab = (event: PointerEvent) => {
    (event.currentTarget as Element).setPointerCapture(event.pointerId);
    start.current = poles;
  };
  const drag = (event: PointerEvent) => {
    if (start.current) setDraftPoles(group, movePole(start.current, index, readPlace(event)));
  };
  const release = () => {
    start.current = null;
  };
  const answer = (event: KeyboardEvent) => {
    const arrow = ARROWS[event.key];
    if (arrow === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const step = event.shiftKey ? FAR : 1;
    setDraftPoles(group, stepPole(poles, index, arrow[0] * step, arrow[1] * step));
  };
  return (
    <g
      class={`grab pole is-${group}`}
      role="slider"
      tabindex={0}
      transform={`translate(${xOf(pole.re)} ${yOf(pole.im)})`}
      aria-label={t("design.pole", { group: name, index: index + 1, count: poles.length })}
      aria-valuenow={pole.re}
      aria-valuemin={MIN_RE}
      aria-valuemax={MAX_RE}
      aria-valuetext={t("design.poleValue", { value: describePole(pole) })}
      aria-describedby="plane-hint"
      onPointerDown={grab}
      onPointerMove={drag}
      onPointerUp={release}
      onPointerCancel={release}
      onKeyDown={answer}
    >
      <circle class="pole-reach" r="14" />
      <path class="outline" stroke-width="3" d={MARKS[group]} />
    </g>
  );
}

/** The poles in use, faint, behind those of the draft. */
function Shadows({ now }: { now: Draft }) {
  return (
    <svg fill="none" stroke="var(--edge)" stroke-width="1.6" opacity="0.6" aria-hidden="true">
      {GROUPS.flatMap((group) =>
        countPlaces(now[group]).map(({ pole }) => (
          <path
            key={`${group}${pole.re},${pole.im}`}
            d={MARKS[group]}
            transform={`translate(${xOf(pole.re)} ${yOf(pole.im)})`}
          />
        )),
      )}
    </svg>
  );
}

function Counts({ group, poles }: { group: Group; poles: Poles }) {
  const side = group === "position" ? -12 : 23;
  return (
    <svg class={`is-${group}`} aria-hidden="true">
      {countPlaces(poles)
        .filter(({ count }) => count > 1)
        .map(({ pole, count }) => (
          <text
            key={`${pole.re},${pole.im}`}
            class="tone"
            x={xOf(pole.re)}
            y={yOf(pole.im) + side}
            text-anchor="middle"
          >
            {t("design.many", { count })}
          </text>
        ))}
    </svg>
  );
}

/** The six poles. */
export function Plane() {
  const picture = useRef<SVGSVGElement>(null);
  const tried = draft.value;
  const now = designInUse.value;
  const readPlace = (event: PointerEvent): Pole => {
    const box = (picture.current as SVGSVGElement).getBoundingClientRect();
    return {
      re: MIN_RE + ((event.clientX - box.left) / box.width) * (MAX_RE - MIN_RE),
      im: MAX_IM - ((event.clientY - box.top) / box.height) * 2 * MAX_IM,
    };
  };
  if (tried === null || now === null) return null;
  return (
    // biome-ignore lint/a11y/useSemanticElements: a group of sliders in a drawing
    <svg
      ref={picture}
      class="drawing sunken plane"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      role="group"
      aria-label={t("design.plane")}
    >
      <Ground />
      <FastestMark />
      <ObserverMark bandwidth={tried.observer[0]} />
      <Shadows now={now} />
      {GROUPS.map((group) => (
        <g key={group}>
          {tried[group].map((_, index) => (
            <PoleMark
              key={index}
              group={group}
              poles={tried[group]}
              index={index}
              readPlace={readPlace}
            />
          ))}
          <Counts group={group} poles={tried[group]} />
        </g>
      ))}
    </svg>
  );
}
