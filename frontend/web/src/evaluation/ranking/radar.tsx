import type { Row, SweepOutcome } from "../../core/api/ranking";
import type { LineStyle } from "../../core/plots/definitions";
import { dotOf } from "../../core/plots/linestyles";
import { titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { chosen, lineStyles, rowOf, see } from "./ranking";

const words = text.ranking;
const RADIUS = 96;
const RINGS = [0.25, 0.5, 0.75, 1];

/** Where the share of a sweep lies: axis 0 upward, the others clockwise. */
export function pointOf(axis: number, axes: number, share: number): [number, number] {
  const angle = (2 * Math.PI * axis) / axes;
  return [RADIUS * share * Math.sin(angle), -RADIUS * share * Math.cos(angle)];
}

const outline = (shares: readonly number[]): string =>
  shares
    .map((share, axis) =>
      pointOf(axis, shares.length, share)
        .map((at) => at.toFixed(1))
        .join(","),
    )
    .join(" ");

/** The greatest value up to which every run held, in the direction of worse; null for none. */
export function bearsUpTo(sweep: SweepOutcome): number | null {
  const first = sweep.passed.findIndex((share) => share < 1);
  const last = first < 0 ? sweep.values.length - 1 : first - 1;
  return last < 0 ? null : (sweep.values[last] as number);
}

/** The widest stretch about the nominal model in which every run held. */
export function bearsFromTo(sweep: SweepOutcome): readonly [number, number] | null {
  const middle = sweep.values.indexOf(1);
  if ((sweep.passed[middle] ?? 0) < 1) return null;
  let [low, high] = [middle, middle];
  while (low > 0 && sweep.passed[low - 1] === 1) low--;
  while (high < sweep.values.length - 1 && sweep.passed[high + 1] === 1) high++;
  return [sweep.values[low] as number, sweep.values[high] as number];
}

function boundOf(sweep: SweepOutcome): string {
  if (sweep.sweep === "model") {
    const range = bearsFromTo(sweep);
    return range === null ? words.bearsNone : words.bearsRange(...range);
  }
  const bound = bearsUpTo(sweep);
  if (bound === null) return words.bearsNone;
  return words.bears(String(Number(bound.toPrecision(3))), sweep.unit);
}

/** A run of a sweep that did not hold: the first that failed, or the last. */
const runOf = (sweep: SweepOutcome): string => {
  const failed = sweep.passed.findIndex((share) => share < 1);
  const value = sweep.values[failed < 0 ? sweep.values.length - 1 : failed] as number;
  return `${sweep.sweep}_${Number(value.toPrecision(3))}_0`;
};

function Web({ found }: { found: readonly Row[] }) {
  const sweeps = found[0]?.sweeps ?? [];
  return (
    <svg
      class="drawing ranking-radar"
      viewBox="-190 -128 380 256"
      role="img"
      aria-label={words.radarLabel}
    >
      {RINGS.map((ring) => (
        <polygon key={ring} class="grid" points={outline(sweeps.map(() => ring))} />
      ))}
      {sweeps.map(({ sweep }, axis) => {
        const [x, y] = pointOf(axis, sweeps.length, 1);
        const [atX, atY] = pointOf(axis, sweeps.length, 1.13);
        const anchor = Math.abs(atX) < 1 ? "middle" : atX > 0 ? "start" : "end";
        return (
          <g key={sweep}>
            <line class="grid" x1="0" y1="0" x2={x} y2={y} />
            <text x={atX} y={atY + 4} text-anchor={anchor}>
              {words.sweeps[sweep] ?? sweep}
            </text>
          </g>
        );
      })}
      {found.map((row) => {
        const { colour, dash } = lineStyles.value.get(row.law) as LineStyle;
        const stroke = `var(--plot-${colour})`;
        return (
          <polygon
            key={row.law}
            class="ranking-outline"
            points={outline(row.sweeps.map(({ share }) => share))}
            style={{ stroke, fill: stroke, strokeDasharray: dash.join(" ") }}
          />
        );
      })}
    </svg>
  );
}

/** What the web shows in numbers; a press shows where a law no longer holds. */
function Shares({ found }: { found: readonly Row[] }) {
  return (
    <table class="table menu ranking-shares">
      <caption>{words.sharesCaption}</caption>
      <thead>
        <tr>
          <td />
          {found.map((row) => (
            <th key={row.law} scope="col">
              <i class="dot" aria-hidden="true" style={dotOf(lineStyles.value.get(row.law))} />
              {titleOf(row.law)}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {(found[0]?.sweeps ?? []).map(({ sweep }, axis) => (
          <tr key={sweep}>
            <th scope="row">{words.sweeps[sweep] ?? sweep}</th>
            {found.map((row) => {
              const one = row.sweeps[axis] as SweepOutcome;
              const share = words.percent(one.share);
              return (
                <td key={row.law}>
                  <button
                    type="button"
                    title={words.seeSweep}
                    aria-label={words.sweepLabel(titleOf(row.law), share, boundOf(one))}
                    onClick={() => void see(row.law, runOf(one))}
                  >
                    {share} <small>{boundOf(one)}</small>
                  </button>
                </td>
              );
            })}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** The six sweeps of robustness of the laws that are chosen. */
export function Radar() {
  const found = chosen.value.flatMap((law) => rowOf(law) ?? []);
  return (
    <section class="surface card" aria-labelledby="ranking-radar-title">
      <h3 id="ranking-radar-title">{words.radar}</h3>
      {found.length === 0 ? (
        <p class="hint">{words.chooseSome}</p>
      ) : (
        <>
          <Web found={found} />
          <Shares found={found} />
        </>
      )}
    </section>
  );
}
