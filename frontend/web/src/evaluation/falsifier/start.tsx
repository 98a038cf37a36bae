import schema from "schema:FalsificationRequest";
import { useState } from "preact/hooks";
import type { Adversary, AdversaryState } from "../../core/api/falsifications";
import { FieldError } from "../../core/forms/controls";
import { Fields, RequestFields } from "../../core/forms/fields";
import { useRequest } from "../../core/forms/request";
import { readField } from "../../core/schema";
import { usableLaws } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { SelectField } from "../../core/widgets/form";
import { NumberField } from "../../core/widgets/numberinput";
import { OWN, SourceField } from "../campaign/sourcefield";
import { describeTerms, EFFECTS, FIGURES, readModelError, writeModelError } from "./definition";
import { adversaries, isBusy, startNewSearch } from "./falsifier";

const { definition: adversary = {}, ...properties } = schema.properties ?? {};
const terms = readField(adversary).properties?.terms ?? {};

interface PartProps {
  definition: Adversary;
  onChange: (changed: Partial<Adversary>) => void;
}

/** Base of the runs: effects, references. */
function Base({ definition: { base }, onChange }: PartProps) {
  const effects = EFFECTS.find((effect) => effect === (base.effects ?? "ideal"));
  return (
    <div class="pair">
      <SelectField
        label={t("falsifier.effects")}
        value={effects ?? "given"}
        options={effects ? EFFECTS : [...EFFECTS, "given" as const]}
        name={(effect) => t(`falsifier.effect.${effect}`)}
        onChoose={(effect) =>
          effect !== "given" && onChange({ base: { ...base, effects: effect } })
        }
      />
      <SelectField
        label={t("falsifier.figure")}
        value={String(base.figure ?? FIGURES[0])}
        options={FIGURES}
        name={(figure) => t(`figures.name.${figure as (typeof FIGURES)[number]}`)}
        onChoose={(figure) => onChange({ base: { ...base, figure } })}
      />
    </div>
  );
}

/** Perturbations of inertia and spring as one number; others are kept. */
function ModelError({ definition: { vary }, onChange }: PartProps) {
  return (
    <NumberField
      label={t("falsifier.off")}
      unit="%"
      title={t("falsifier.offHint")}
      min={0}
      max={90}
      value={readModelError(vary)}
      onInput={(percent) => onChange({ vary: writeModelError(vary, percent) })}
      below={<FieldError path="definition.vary" schema={{ title: t("falsifier.off") }} />}
    />
  );
}

function Definition({ definition, onChange }: PartProps) {
  const parts = { definition, onChange };
  return (
    <Fields
      schema={adversary}
      path="definition"
      value={definition}
      onChange={(next) => {
        const changed = next as unknown as Adversary;
        const isSame = changed.terms === definition.terms;
        onChange(isSame ? changed : { ...changed, title: describeTerms(changed.terms, terms) });
      }}
      replace={{ title: null, base: <Base {...parts} />, vary: <ModelError {...parts} /> }}
    />
  );
}

/** Bounds and objective of a search: a built-in adversary, changed, or text. */
function SearchForm({ known, first }: { known: readonly AdversaryState[]; first: AdversaryState }) {
  const [source, setSource] = useState(first.name);
  const [own, setOwn] = useState("");
  const start = { definition: first.definition };
  const form = useRequest(schema, { law: usableLaws.value }, start);
  const isOwn = source === OWN;
  const definition = form.body.definition as Adversary;
  const set = (changed: object) => form.set({ ...form.body, ...changed });
  return (
    <form
      class="surface card stack form"
      onSubmit={(event) => {
        event.preventDefault();
        void form.attempt(({ definition: changed, law, ...body }) =>
          startNewSearch({ ...body, ...(isOwn ? { text: own, law } : { definition: changed }) }),
        );
      }}
    >
      <h3>{t("falsifier.begin")}</h3>
      <RequestFields
        form={form}
        schema={schema}
        replace={{
          adversary: (
            <SourceField
              label={properties.adversary?.title ?? ""}
              own={{ name: t("falsifier.own"), label: properties.text?.title ?? "" }}
              templates={known}
              source={source}
              text={own}
              onChange={(name, written) => {
                setSource(name);
                setOwn(written);
                const template = known.find((candidate) => candidate.name === name);
                if (template && name !== source) set({ definition: template.definition });
              }}
            />
          ),
          text: null,
          ...(isOwn
            ? { definition: null }
            : {
                law: null,
                definition: (
                  <Definition
                    definition={definition}
                    onChange={(changed) => set({ definition: { ...definition, ...changed } })}
                  />
                ),
              }),
        }}
      />
      <div class="row">
        <button type="submit" class="button is-primary" disabled={isBusy.value !== ""}>
          {t("falsifier.search")}
        </button>
      </div>
    </form>
  );
}

export function Start() {
  const [first] = adversaries.value;
  return first ? <SearchForm known={adversaries.value} first={first} /> : null;
}
