import { useState } from "preact/hooks";
import { checkStudy, type StudyChanges, type StudyPlan } from "../../core/api/studies";
import { describeError } from "../../core/state/actions";
import { titleOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { SelectField } from "../../core/widgets/form";
import { NumberField } from "../../core/widgets/numberinput";
import { Boxes, LawBoxes } from "../../core/widgets/pagelayout";
import { OWN, SourceField } from "../campaign/sourcefield";
import { isBusy, list, problem, startNewStudy } from "./studies";
import { factorOf, nameColumn } from "./studyview";

const FIRST = "load";
const MAX_RUNS = 1_000_000_000;

/** Select, change, check and start a study; an error is shown with line, name and bound. */
export function Start() {
  const [source, setSource] = useState(FIRST);
  const [own, setOwn] = useState("");
  const [name, setName] = useState("");
  const [runs, setRuns] = useState<number | null>(null);
  const [laws, setLaws] = useState<readonly string[]>([]);
  const [chosenMetrics, setChosenMetrics] = useState<readonly string[]>([]);
  const [metric, setMetric] = useState("");
  const [bound, setBound] = useState<number | null>(null);
  const [plan, setPlan] = useState<StudyPlan | null>(null);
  const builtIn = list.value?.built_in ?? [];
  const metrics = list.value?.metrics ?? [];
  const offered = metrics.map((column) => ({ name: column.name, title: nameColumn(column) }));
  const successMetric = metrics.find((column) => column.name === metric);
  const build = (): StudyChanges => ({
    ...(source === OWN ? { text: own } : { source }),
    ...(name !== "" && { name }),
    ...(runs !== null && { runs }),
    ...(laws.length > 0 && { laws }),
    ...(chosenMetrics.length > 0 && { metrics: chosenMetrics }),
    ...(successMetric && {
      success: { [successMetric.name]: (bound ?? 0) / factorOf(successMetric.unit) },
    }),
  });
  const check = async () => {
    try {
      setPlan(await checkStudy(build()));
      problem.value = "";
    } catch (error) {
      setPlan(null);
      problem.value = describeError(error);
    }
  };
  const change = (next: () => void) => {
    next();
    setPlan(null);
  };
  return (
    <form
      class="surface card stack form"
      onSubmit={(event) => {
        event.preventDefault();
        void startNewStudy(build());
      }}
    >
      <h3>{t("studies.begin")}</h3>
      <SourceField
        label={t("studies.source")}
        own={{ name: t("studies.own"), label: t("studies.text") }}
        templates={builtIn}
        source={source}
        text={own}
        onChange={(chosen, written) =>
          change(() => {
            setSource(chosen);
            setOwn(written);
          })
        }
      />
      <NumberField
        label={t("studies.runs")}
        title={t("studies.runsHint")}
        isInteger
        min={1}
        max={MAX_RUNS}
        placeholder={t("studies.asInStudy")}
        value={runs}
        onInput={(value) => change(() => setRuns(value))}
        onEmpty={() => change(() => setRuns(null))}
      />
      <label title={t("studies.nameHint")}>
        <span>{t("studies.name")}</span>
        <input
          type="text"
          maxLength={64}
          placeholder={source || "own"}
          value={name}
          onInput={(event) => change(() => setName(event.currentTarget.value))}
        />
      </label>
      <details>
        <summary>
          {t("studies.laws")}:{" "}
          {laws.length === 0 ? t("studies.asInStudy") : laws.map(titleOf).join(", ")}
        </summary>
        <p class="hint">{t("studies.lawsHint")}</p>
        <LawBoxes laws={laws} onChange={(next) => change(() => setLaws(next))} />
      </details>
      <details>
        <summary>
          {t("studies.metrics")}:{" "}
          {chosenMetrics.length === 0 ? t("studies.asInStudy") : chosenMetrics.length}
        </summary>
        <p class="hint">{t("studies.metricsHint")}</p>
        <Boxes
          offered={offered}
          chosen={chosenMetrics}
          onChange={(next) => change(() => setChosenMetrics(next))}
        />
      </details>
      <SelectField
        label={t("studies.success")}
        title={t("studies.successHint")}
        value={metric}
        options={["", ...offered.map((option) => option.name)]}
        name={(metricName) =>
          offered.find(({ name }) => name === metricName)?.title ?? t("studies.asInStudy")
        }
        onChoose={(chosen) => change(() => setMetric(chosen))}
      />
      <NumberField
        label={t("studies.most")}
        unit={successMetric?.unit ?? ""}
        disabled={metric === ""}
        value={bound}
        onInput={(value) => change(() => setBound(value))}
      />
      <div class="row">
        <button
          type="button"
          class="button"
          onClick={(event) => {
            if (event.currentTarget.form?.reportValidity()) void check();
          }}
        >
          {t("studies.check")}
        </button>
        <button type="submit" class="button is-primary" disabled={isBusy.value !== ""}>
          {t("studies.start")}
        </button>
      </div>
      {plan && (
        <p class="hint" role="status">
          {t("studies.checked", {
            samples: plan.samples,
            rows: plan.rows,
            laws: plan.laws.map(titleOf).join(", "),
          })}
        </p>
      )}
    </form>
  );
}
