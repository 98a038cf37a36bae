import schema from "schema:StudyRequest";
import { useState } from "preact/hooks";
import { checkStudy, type StudyPlan } from "../../core/api/studies";
import { RequestFields } from "../../core/forms/fields";
import { useRequest } from "../../core/forms/request";
import type { Values } from "../../core/schema";
import { titleOf, usableLaws } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { OWN, SourceField } from "../campaign/sourcefield";
import { list } from "./selection";
import { isBusy, startNewStudy } from "./studies";
import { nameColumn } from "./studyview";

const FIRST = "load";

/** Select, change, check and start a study. */
export function Start() {
  const [source, setSource] = useState(FIRST);
  const [own, setOwn] = useState("");
  const [plan, setPlan] = useState<StudyPlan | null>(null);
  const metrics = list.value?.metrics ?? [];
  const form = useRequest(schema, {
    laws: usableLaws.value,
    metrics: metrics.map((column) => ({ name: column.name, title: nameColumn(column) })),
  });
  const build = (body: Values) => ({
    ...body,
    ...(source === OWN ? { text: own } : { source }),
  });
  const set = (body: Values) => {
    form.set(body);
    setPlan(null);
  };
  return (
    <form
      class="surface card stack form"
      onSubmit={(event) => {
        event.preventDefault();
        void form.attempt((body) => startNewStudy(build(body)));
      }}
    >
      <h3>{t("studies.begin")}</h3>
      <RequestFields
        form={{ ...form, set }}
        schema={schema}
        replace={{
          source: (
            <SourceField
              label={schema.properties?.source?.title ?? ""}
              own={{ name: t("studies.own"), label: schema.properties?.text?.title ?? "" }}
              templates={list.value?.built_in ?? []}
              source={source}
              text={own}
              onChange={(chosen, written) => {
                setSource(chosen);
                setOwn(written);
                setPlan(null);
              }}
            />
          ),
          text: null,
        }}
      />
      <div class="row">
        <button
          type="button"
          class="button"
          onClick={async ({ currentTarget }) => {
            if (!currentTarget.form?.reportValidity()) return;
            setPlan(await form.attempt((body) => checkStudy(build(body))));
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
