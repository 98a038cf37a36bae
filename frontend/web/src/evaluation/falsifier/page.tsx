import { useComputed } from "@preact/signals";
import { useEffect, useMemo, useState } from "preact/hooks";
import type { Law } from "../../core/api/types";
import { isJobRunning } from "../../core/jobs/progress";
import type { LineStyle } from "../../core/plots/definitions";
import { lineStylesOfLaws } from "../../core/plots/linestyles";
import { mayCall } from "../../core/state/access";
import { laws as installedLaws, titleOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { PageWithForm } from "../../core/widgets/pagelayout";
import { ResultMenu } from "../campaign/resultmenu";
import {
  findingOf,
  follow,
  laws,
  leave,
  openLists,
  problem,
  savedScenarios,
  scenario,
  searches,
  selection,
} from "./falsifier";
import { Laws } from "./laws";
import { type DrawnLaw, TracePlots } from "./picture";
import { ScenarioResult } from "./scenarioresult";
import { Start } from "./start";
import { keyOf, lastTrace, shownTrace, traceSelection } from "./traces";

const MAX_DRAWN = 4;

function SavedScenarios() {
  const { search: shown, scenario: name } = selection.value;
  return (
    <>
      <ResultMenu
        title={t("falsifier.kept")}
        loading={savedScenarios.value === null && problem.value === "" && t("falsifier.loading")}
        shown={name}
        results={(savedScenarios.value ?? []).map((saved) => ({
          key: saved.name,
          to: { kind: "falsifier", search: "", scenario: saved.name, laws: [] },
          title: saved.title,
          name: saved.name,
          isExample: saved.is_example,
          state: findingOf(saved.scenario)?.outcome ?? saved.title,
        }))}
      />
      {searches.value !== null && searches.value.length > 0 && (
        <ResultMenu
          title={t("falsifier.searches")}
          shown={shown}
          results={searches.value.map((search) => ({
            key: search.id,
            to: { kind: "falsifier", search: search.id, scenario: "", laws: [] },
            title: search.title,
            name: titleOf(search.law),
            state:
              (!isJobRunning(search) && search.scenario && findingOf(search.scenario)?.outcome) ||
              t(`jobs.status.${search.status}`),
          }))}
        />
      )}
    </>
  );
}

/** The latest picture and outcomes of the laws. */
function Under() {
  const shownScenario = scenario.value;
  const [picked, setPicked] = useState<readonly Law[] | null>(null);
  const requestedKey = useComputed(() => scenario.value && keyOf(scenario.value, laws.value)).value;
  useEffect(() => void traceSelection(), [requestedKey]);
  const trace = shownTrace.value;
  const names = picked ?? trace?.laws.map(({ law }) => law).slice(0, MAX_DRAWN) ?? [];
  const installed = installedLaws.value;
  const drawn = useMemo(() => {
    const tracedLaws = names.flatMap((law) => trace?.laws.find((other) => other.law === law) ?? []);
    const lineStyles = lineStylesOfLaws(tracedLaws.map(({ law }) => law));
    return tracedLaws.map(
      (lawTrace, index): DrawnLaw => ({ ...lawTrace, lineStyle: lineStyles[index] as LineStyle }),
    );
  }, [trace, names.join(), installed]);
  if (shownScenario === null) return null;
  if (!mayCall("post", "/scenarios/runs"))
    return <p class="hint wide">{t("falsifier.observer")}</p>;
  if (trace === null)
    return <p class="hint wide">{problem.value === "" && t("falsifier.running")}</p>;
  const draw = (law: Law) =>
    setPicked(names.includes(law) ? names.filter((name) => name !== law) : [...names, law]);
  return (
    <>
      <TracePlots scenario={shownScenario} trace={trace} drawn={drawn} />
      <Laws
        traces={trace.laws}
        drawn={drawn}
        isRunning={lastTrace.value?.key !== requestedKey && problem.value === ""}
        onDraw={draw}
      />
    </>
  );
}

/** The worst-case load of a law: search, simplify, save, and run other laws in it. */
export function FalsifierPage() {
  const { search: id, scenario: name } = selection.value;
  useEffect(() => {
    void openLists();
  }, []);
  useEffect(() => {
    void follow(id);
    return () => leave(id || name);
  }, [id, name]);
  return (
    <PageWithForm
      title={t("falsifier.title")}
      lead={t("falsifier.lead")}
      problem={problem.value}
      side={
        <>
          <SavedScenarios />
          <Start />
        </>
      }
    >
      <div class="halves">
        <ScenarioResult scenario={scenario.value} />
        <Under key={`${id} ${name}`} />
      </div>
    </PageWithForm>
  );
}
