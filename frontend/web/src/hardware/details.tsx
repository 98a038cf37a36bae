import type { BenchState } from "../core/api/types";
import { isLive } from "../core/state/session";
import { t } from "../core/text/t";
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
    <section class="surface small bench-card is-problems" aria-label={t("bench.problems")}>
      <h2 class="bad">
        <span aria-hidden="true">▲</span> {t("bench.problems")}
      </h2>
      <ul class="bullets cells">
        {problems.map((problem) => (
          <li key={problem}>{problem}</li>
        ))}
      </ul>
    </section>
  );
}

function Age({ seconds, level }: { seconds: number; level: Freshness }) {
  if (!isLive.value) return <td class="breaks">{t("bench.drives.notKnown")}</td>;
  if (level === "silent" || level === "unheard")
    return <td class="breaks">{t(`bench.drives.${level}`)}</td>;
  return (
    <td class={level === "fresh" ? "good" : "bad"}>
      <span aria-hidden="true">{SIGNS[level]}</span>{" "}
      {t("bench.drives.ago", { lapse: formatLapse(seconds) })}
      {level === "fresh" ? (
        <span class="visually-hidden"> {t("bench.drives.levels.fresh")}</span>
      ) : (
        <strong> {t(`bench.drives.levels.${level}`)}</strong>
      )}
    </td>
  );
}

function Drives({ bench }: { bench: BenchState }) {
  const { ages_s: ages, current_a: currents, supervised } = bench;
  return (
    <section class="surface small bench-card" aria-label={t("bench.drives.heading")}>
      <h2>{t("bench.drives.heading")}</h2>
      <table>
        <thead>
          <tr>
            <th scope="col">{t("bench.drives.source")}</th>
            <th scope="col">{t("bench.drives.current")}</th>
            <th scope="col">{t("bench.heat.column")}</th>
            <th scope="col">{t("bench.drives.age")}</th>
          </tr>
        </thead>
        <tbody>
          {ages.map((age, index) => {
            const speaks = index >= DRIVES || !QUIET.includes(bench.status);
            const level = freshnessOf(age, bench, speaks);
            const isSending = SENDING_SIGNS.includes(level);
            const current = isSending ? currents?.[index] : undefined;
            return (
              <tr key={t("bench.drives.names", { returnObjects: true })[index]}>
                <th scope="row">{t("bench.drives.names", { returnObjects: true })[index]}</th>
                <td>
                  {current === undefined
                    ? t("bench.drives.none")
                    : t("bench.drives.amperes", { value: formatNumber(current, 3, 2) })}
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
          {supervised ? t("bench.drives.supervised") : t("bench.drives.unsupervised")}
        </p>
      )}
    </section>
  );
}

function Calibration({ bench }: { bench: BenchState }) {
  const { calibrated_by: by, calibrated_on: on } = bench;
  return (
    <section class="surface small bench-card" aria-label={t("bench.calibration")}>
      <h2>{t("bench.calibration")}</h2>
      {on === null ? (
        <p class="bad">
          <span aria-hidden="true">▲</span> {t("bench.uncalibrated")}
        </p>
      ) : (
        <p>
          <time dateTime={on}>{on.slice(0, 16).replace("T", " ")}</time>
          {by !== null && ` ${t("bench.calibrated", { by })}`}
        </p>
      )}
      <h3>{bench.name}</h3>
      <p class="hint">
        {t("bench.interface")}: {bench.interface}
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
