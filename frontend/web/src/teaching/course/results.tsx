import type { CriterionResult, Step } from "../../core/api/course";
import { showSpan } from "../../core/plots/span";
import { samples, session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { formatFixed } from "../../core/units";
import { goTo } from "../../runs/list/place";
import { stepRun } from "./steprun";

const MIN_GAP_S = 0.5;

const wordOf = ({ points, max_points: most }: CriterionResult) =>
  points >= most ? "right" : points > 0 ? "partly" : "wrong";

const TONES = { right: "is-good", partly: "is-warn", wrong: "is-bad" } as const;

/** A link to the moment in the plots if they still have that run; otherwise in its replay. */
function showInPlots(run: string, timeS: number): void {
  const { ring } = samples;
  const shown = stepRun.peek().shown;
  const isShown = shown?.run === run && shown.runNumber === session.peek()?.run_number;
  if (isShown && ring.oldestTime <= timeS && timeS <= ring.newestTime) {
    showSpan({ from: timeS - MIN_GAP_S, to: timeS + MIN_GAP_S });
    document.getElementById("plots")?.scrollIntoView({ block: "nearest" });
  } else goTo({ kind: "run", run, timeS });
}

/** The result of a step: points, feedback, and links to the relevant moments. */
export function Results({
  of,
  results,
  run,
}: {
  of: Step;
  results: readonly CriterionResult[];
  run: string | null;
}) {
  if (results.length === 0) return null;
  return (
    <section aria-label={`${t("lesson.results")}: ${of.title}`}>
      <h4>{t("lesson.results")}</h4>
      <ul class="stack small">
        {results.map((result) => (
          <li key={result.name} class={`note ${TONES[wordOf(result)]}`}>
            <p>
              <strong class="tone">{t(`lesson.${wordOf(result)}`)}</strong>{" "}
              <span>{result.name}</span>{" "}
              <small>
                {result.points} / {result.max_points}
              </small>
            </p>
            <p class="as-written">{result.feedback}</p>
            {run !== null && typeof result.time_s === "number" && (
              <button
                type="button"
                class="button"
                title={t("lesson.showHint")}
                onClick={() => showInPlots(run, result.time_s as number)}
              >
                {t("lesson.show", { time: formatFixed(result.time_s, 2) })}
              </button>
            )}
          </li>
        ))}
      </ul>
    </section>
  );
}
