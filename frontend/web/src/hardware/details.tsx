import type { BenchState } from "../core/api/types";
import { isLive } from "../core/state/session";
import { text } from "../core/text/en";
import { formatLapse, formatNumber } from "../core/units";
import { Heat } from "./heat";
import { Homing } from "./homing";
import { Loop } from "./loop";
import { type Freshness, freshnessOf, isStarting } from "./status";

const SIGNS = { fresh: "✓", stale: "▲", lost: "▲" } as const;
/** The first two sources; the third is the deflection encoder. */
const DRIVES = 2;
/** Older values are not shown. */
const SENDING_SIGNS: readonly Freshness[] = ["fresh", "stale"];
/** Drives send nothing before they are enabled, nor after a fault. */
const QUIET: readonly BenchState["status"][] = ["off", "reset", "config", "mode", "fault"];

function Problems({ problems }: { problems: readonly string[] }) {
  return (
    <section class="surface small bench-card is-problems" aria-label={text.bench.problems}>
      <h2 class="bad">
        <span aria-hidden="true">▲</span> {text.bench.problems}
      </h2>
      <ul class="bullets">
        {problems.map((problem) => (
          <li key={problem}>{problem}</li>
        ))}
      </ul>
    </section>
  );
}

function Age({ seconds, level }: { seconds: number; level: Freshness }) {
  const { drives } = text.bench;
  if (!isLive.value) return <td class="breaks">{drives.notKnown}</td>;
  if (level === "silent" || level === "unheard") return <td class="breaks">{drives[level]}</td>;
  return (
    <td class={level === "fresh" ? "good" : "bad"}>
      <span aria-hidden="true">{SIGNS[level]}</span> {drives.ago(formatLapse(seconds))}
      {level === "fresh" ? (
        <span class="visually-hidden"> {drives.levels.fresh}</span>
      ) : (
        <strong> {drives.levels[level]}</strong>
      )}
    </td>
  );
}

function Drives({ bench }: { bench: BenchState }) {
  const { drives } = text.bench;
  const { ages_s: ages, current_a: currents, supervised } = bench;
  return (
    <section class="surface small bench-card is-drives" aria-label={drives.heading}>
      <h2>{drives.heading}</h2>
      <table>
        <thead>
          <tr>
            <th scope="col">{drives.source}</th>
            <th scope="col">{drives.current}</th>
            <th scope="col">{text.bench.heat.column}</th>
            <th scope="col">{drives.age}</th>
          </tr>
        </thead>
        <tbody>
          {ages.map((age, index) => {
            const speaks = index >= DRIVES || !QUIET.includes(bench.status);
            const level = freshnessOf(age, bench, speaks);
            const isSending = SENDING_SIGNS.includes(level);
            const current = isSending ? currents?.[index] : undefined;
            return (
              <tr key={drives.names[index]}>
                <th scope="row">{drives.names[index]}</th>
                <td>
                  {current === undefined
                    ? drives.none
                    : drives.amperes(formatNumber(current, 3, 2))}
                </td>
                <Heat motor={bench.motors?.[index]} />
                <Age seconds={age} level={level} />
              </tr>
            );
          })}
        </tbody>
      </table>
      {isLive.value && !isStarting(bench) && (
        <p class={supervised ? "good" : "bad"}>
          <span aria-hidden="true">{supervised ? "✓" : "▲"}</span>{" "}
          {supervised ? drives.supervised : drives.unsupervised}
        </p>
      )}
    </section>
  );
}

function Calibration({ bench }: { bench: BenchState }) {
  const { calibrated_by: by, calibrated_on: on } = bench;
  return (
    <section class="surface small bench-card is-calibration" aria-label={text.bench.calibration}>
      <h2>{text.bench.calibration}</h2>
      {on === null ? (
        <p class="bad">
          <span aria-hidden="true">▲</span> {text.bench.uncalibrated}
        </p>
      ) : (
        <p>
          <time dateTime={on}>{on.slice(0, 16).replace("T", " ")}</time>
          {by !== null && ` ${text.bench.calibrated(by)}`}
        </p>
      )}
      <h3>{bench.name}</h3>
      <p class="hint">
        {text.bench.interface}: {bench.interface}
      </p>
    </section>
  );
}

/** All data of the bench. */
export function BenchDetails({ bench }: { bench: BenchState }) {
  return (
    <div class="bench-details">
      {bench.problems.length > 0 && <Problems problems={bench.problems} />}
      <Homing bench={bench} />
      <Drives bench={bench} />
      <Calibration bench={bench} />
      <Loop loop={bench.loop} />
    </div>
  );
}
