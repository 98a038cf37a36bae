import { signal } from "@preact/signals";
import type { Figure } from "../../core/api/types";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { figureClaims, loadClaims } from "./claimtexts";
import { ErrorCourse } from "./course";
import { type Course, judge, measure, type Numbers } from "./outcome";
import { runFigureApart } from "./trial";

const words = text.claims;
const FIGURES: readonly Figure[] = ["4a", "4b", "5"];

interface Trial {
  figure: Figure;
  course: Course | null;
  problem: string;
}

const trial = signal<Trial | null>(null);

async function check(figure: Figure): Promise<void> {
  trial.value = { figure, course: null, problem: "" };
  try {
    const [course] = await Promise.all([runFigureApart(figure), loadClaims()]);
    if (trial.peek()?.figure === figure) trial.value = { figure, course, problem: "" };
  } catch (error) {
    trial.value = { figure, course: null, problem: error instanceof Error ? error.message : "" };
  }
}

const degrees = (value: number) => formatNumber(value, 3, 4);

function NumbersTable({ fl, ndobc }: { fl: Numbers; ndobc: Numbers }) {
  const rows = [
    [words.rows.before, words.degrees, fl.beforeDeg, ndobc.beforeDeg],
    [words.rows.peak, words.degrees, fl.peakDeg, ndobc.peakDeg],
    [words.rows.steady, words.degrees, fl.steadyDeg, ndobc.steadyDeg],
    [words.rows.stiffness, words.stiffnessUnit, fl.stiffnessSteady, ndobc.stiffnessSteady],
  ] as const;
  return (
    <table class="claim-numbers">
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
        {rows.map(([label, unit, first, second]) => (
          <tr key={label}>
            <th scope="row">
              {label} <span class="unit">{unit}</span>
            </th>
            <td>{degrees(first)}</td>
            <td>{degrees(second)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Result({ figure, course }: { figure: Figure; course: Course }) {
  const fl = measure(course, 0);
  const ndobc = measure(course, 1);
  const findings = judge(figure, fl, ndobc);
  const areAll = findings.every(({ holds }) => holds);
  return (
    <section
      class="claim-result"
      role="status"
      aria-label={words.result(text.figures.name[figure])}
    >
      <blockquote>
        <strong>{words.claim}</strong> {figureClaims.value.get(figure)}
      </blockquote>
      <ErrorCourse course={course} />
      <NumbersTable fl={fl} ndobc={ndobc} />
      <ul class="findings">
        {findings.map(({ part, holds }) => (
          <li key={part} class={holds ? "is-held" : "is-failed"}>
            <span aria-hidden="true">{holds ? words.holdsSign : words.holdsNotSign}</span>
            {words.parts[part]}
            <strong>{holds ? words.holds : words.holdsNot}</strong>
          </li>
        ))}
      </ul>
      <p class={`claim-verdict ${areAll ? "is-held" : "is-failed"}`}>
        <strong>{areAll ? words.overall.holds : words.overall.fails}</strong> {words.sizes}
      </p>
    </section>
  );
}

/** The paper's figures as experiments of one press, laid beside what the paper says. */
export function Claims() {
  const now = trial.value;
  const isRunning = now !== null && now.course === null && now.problem === "";
  return (
    <div class="claims">
      <h3>{words.heading}</h3>
      <p class="hint">{words.explanation}</p>
      <div class="claim-buttons">
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
      {now?.problem && (
        <p class="problem" role="alert">
          {words.failed(now.problem)}
        </p>
      )}
      {now?.course && <Result figure={now.figure} course={now.course} />}
    </div>
  );
}
