import { signal } from "@preact/signals";
import type { Claim, ClaimNumbers, Figure } from "../../core/api/types";
import { kinds } from "../../core/state/kinds";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { ErrorLine } from "../../core/widgets/form";
import { ErrorPlot } from "./course";
import { type FigureResult, runFigureInPrivate } from "./trial";

const words = text.claims;
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
    [words.rows.before, words.degrees, "before_deg"],
    [words.rows.peak, words.degrees, "peak_deg"],
    [words.rows.steady, words.degrees, "steady_deg"],
    [words.rows.stiffness, words.stiffnessUnit, "stiffness_steady_nm_per_rad"],
  ] as const satisfies readonly (readonly [string, string, keyof ClaimNumbers])[];
  return (
    <table class="metrics strong">
      <caption class="visually-hidden">{words.numbers}</caption>
      <thead>
        <tr>
          <th scope="col">
            <span class="visually-hidden">{words.quantity}</span>
          </th>
          <th scope="col">{text.controller.fl}</th>
          <th scope="col">{text.controller.ndobc}</th>
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
    <section class="stack" role="status" aria-label={words.result(text.figures.name[figure])}>
      <blockquote class="note small">
        <strong>{words.claim}</strong>{" "}
        {kinds.value?.figures.find(({ key }) => key === figure)?.claim}
      </blockquote>
      <ErrorPlot course={course} />
      <NumbersTable numbers={claim.numbers} />
      <ul class="small">
        {claim.parts.map(({ part, holds }) => (
          <li key={part} class="line">
            <span class={holds ? "good" : "bad"} aria-hidden="true">
              {holds ? words.holdsSign : words.holdsNotSign}
            </span>
            {words.parts[part]}
            <strong class={`end ${holds ? "good" : "bad"}`}>
              {holds ? words.holds : words.holdsNot}
            </strong>
          </li>
        ))}
      </ul>
      <p class="small">
        <strong class={areAll ? "good" : "bad"}>
          {areAll ? words.overall.holds : words.overall.fails}
        </strong>{" "}
        {words.sizes}
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
      <h3>{words.heading}</h3>
      <p class="hint">{words.explanation}</p>
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
            {words.check(text.figures.name[figure])}
          </button>
        ))}
      </div>
      {isRunning && <p role="status">{words.running(text.figures.name[now.figure])}</p>}
      <ErrorLine>{now?.problem ? words.failed(now.problem) : ""}</ErrorLine>
      {now?.result && <Result figure={now.figure} result={now.result} />}
    </div>
  );
}
