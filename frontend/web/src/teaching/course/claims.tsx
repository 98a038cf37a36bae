import { signal } from "@preact/signals";
import type { Claim, ClaimNumbers, Figure } from "../../core/api/types";
import { kinds } from "../../core/state/kinds";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { ErrorLine } from "../../core/widgets/form";
import { ErrorPlot } from "./course";
import { type FigureResult, runFigureInPrivate } from "./trial";

const FIGURES: readonly Figure[] = ["4a", "4b", "5"];

interface Trial {
  figure: Figure;
  result: FigureResult | null;
  problem: string;
}

const trial = signal<Trial | null>(null);

async function check(figure: Figure): Promise<void> {
  trial.value = { figure, result: null, problem: "" };
  try {
    const result = await runFigureInPrivate(figure);
    if (trial.peek()?.figure === figure) trial.value = { figure, result, problem: "" };
  } catch (error) {
    trial.value = { figure, result: null, problem: error instanceof Error ? error.message : "" };
  }
}

const degrees = (value: number | null) => formatNumber(value ?? Number.NaN, 3, 4);

function NumbersTable({ numbers }: Pick<Claim, "numbers">) {
  const rows = [
    [t("claims.rows.before"), t("claims.degrees"), "before_deg"],
    [t("claims.rows.peak"), t("claims.degrees"), "peak_deg"],
    [t("claims.rows.steady"), t("claims.degrees"), "steady_deg"],
    [t("claims.rows.stiffness"), t("claims.stiffnessUnit"), "stiffness_steady_nm_per_rad"],
  ] as const satisfies readonly (readonly [string, string, keyof ClaimNumbers])[];
  return (
    <table class="metrics strong">
      <caption class="visually-hidden">{t("claims.numbers")}</caption>
      <thead>
        <tr>
          <th scope="col">
            <span class="visually-hidden">{t("claims.quantity")}</span>
          </th>
          <th scope="col">{t("controller.fl")}</th>
          <th scope="col">{t("controller.ndobc")}</th>
        </tr>
      </thead>
      <tbody>
        {rows.map(([label, unit, name]) => (
          <tr key={label}>
            <th scope="row">
              {label} <span class="unit">{unit}</span>
            </th>
            {numbers.map((of) => (
              <td key={of.law}>{degrees(of[name])}</td>
            ))}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Result({ figure, result }: { figure: Figure; result: FigureResult }) {
  const { course, claim } = result;
  const areAll = claim.parts.every(({ holds }) => holds);
  return (
    <section
      class="stack"
      role="status"
      aria-label={t("claims.result", { figure: t(`figures.name.${figure}`) })}
    >
      <blockquote class="note small">
        <strong>{t("claims.claim")}</strong>{" "}
        {kinds.value?.figures.find(({ key }) => key === figure)?.claim}
      </blockquote>
      <ErrorPlot course={course} />
      <NumbersTable numbers={claim.numbers} />
      <ul class="small">
        {claim.parts.map(({ part, holds }) => (
          <li key={part} class="line">
            <span class={holds ? "good" : "bad"} aria-hidden="true">
              {holds ? t("claims.holdsSign") : t("claims.holdsNotSign")}
            </span>
            {t(`claims.parts.${part}`)}
            <strong class={`end ${holds ? "good" : "bad"}`}>
              {holds ? t("claims.holds") : t("claims.holdsNot")}
            </strong>
          </li>
        ))}
      </ul>
      <p class="small">
        <strong class={areAll ? "good" : "bad"}>
          {areAll ? t("claims.overall.holds") : t("claims.overall.fails")}
        </strong>{" "}
        {t("claims.sizes")}
      </p>
    </section>
  );
}

/** The paper's figures as experiments with one button each, compared with the paper's claims. */
export function Claims() {
  const now = trial.value;
  const isRunning = now !== null && now.result === null && now.problem === "";
  return (
    <div class="stack">
      <h3>{t("claims.heading")}</h3>
      <p class="hint">{t("claims.explanation")}</p>
      <div class="row">
        {FIGURES.map((figure) => (
          <button
            key={figure}
            type="button"
            class="button"
            aria-pressed={now?.figure === figure}
            disabled={isRunning}
            onClick={() => void check(figure)}
          >
            {t("claims.check", { figure: t(`figures.name.${figure}`) })}
          </button>
        ))}
      </div>
      {isRunning && (
        <p role="status">{t("claims.running", { figure: t(`figures.name.${now.figure}`) })}</p>
      )}
      <ErrorLine>{now?.problem ? t("claims.failed", { why: now.problem }) : ""}</ErrorLine>
      {now?.result && <Result figure={now.figure} result={now.result} />}
    </div>
  );
}
