import { useEffect, useState } from "preact/hooks";
import { type Endurance, predictHeat } from "../core/api/design";
import type { Load } from "../core/api/types";
import { isLive, session } from "../core/state/session";
import { t } from "../core/text/t";
import { formatNumber } from "../core/units";
import { isLoopLost } from "./status";

const PAUSE_MS = 400;

/** Inputs of the prediction: the load, the settings, the other loads. */
function questionOf(load: Load | null): string | null {
  const state = session.value;
  if (load === null || !isLive.value || !state?.bench || isLoopLost(state.bench)) return null;
  const on = state.loads.filter(({ active }) => active).map(({ id }) => id);
  return JSON.stringify([load, state.configuration, on]);
}

/** Next to the load button of a bench: which motor overheats, after which time, and why. */
export function EnduranceNote({ load }: { load: Load | null }) {
  const question = questionOf(load);
  const [prediction, setPrediction] = useState<{
    question: string;
    answer: Endurance | null;
  } | null>(null);
  useEffect(() => {
    if (question === null || load === null) return;
    const ask = () =>
      predictHeat(load).then(
        (answer) => setPrediction({ question, answer }),
        () => setPrediction(null),
      );
    const timer = setTimeout(() => void ask(), PAUSE_MS);
    return () => clearTimeout(timer);
  }, [question]);
  const answer = prediction !== null && prediction.question === question ? prediction.answer : null;
  return (
    <div class="small strong tone is-warn" role="status" hidden={answer === null}>
      {answer !== null && (
        <details>
          <summary>
            {t("bench.endurance.warning", {
              motor: t(`bench.endurance.motor.${answer.motor}`),
              seconds:
                answer.seconds < 1
                  ? t("bench.endurance.instant")
                  : t("bench.endurance.seconds", { seconds: Math.round(answer.seconds) }),
            })}
          </summary>
          {t("bench.endurance.why", {
            torque: formatNumber(answer.torque_nm, 3, 2),
            lasting: formatNumber(answer.lasting_torque_nm, 3, 2),
          })}
        </details>
      )}
    </div>
  );
}
