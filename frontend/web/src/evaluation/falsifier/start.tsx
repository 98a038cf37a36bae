import { useState } from "preact/hooks";
import type { Adversary } from "../../core/api/falsifications";
import { titleOf, usableLaws } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { SelectField } from "../../core/widgets/form";
import { NumberField } from "../../core/widgets/numberinput";
import { SourceField } from "../campaign/sourcefield";
import {
  type AdversaryForm,
  describeTerms,
  EFFECTS,
  FIGURES,
  HARMS,
  readForm,
  type TermForm,
  writeForm,
} from "./definition";
import { adversaries, isBusy, startNewSearch } from "./falsifier";
import { TermFields } from "./term";

const RUNS = 20_000;

/** Base of the runs: effects, references. */
function Base({ form, onChange }: FieldsProps) {
  const { base } = form;
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

interface FieldsProps {
  form: AdversaryForm;
  onChange: (changed: Partial<AdversaryForm>) => void;
}

function Loads({ form, onChange }: FieldsProps) {
  const { terms } = form;
  const set = (next: readonly TermForm[]) => onChange({ terms: next, title: describeTerms(next) });
  return (
    <fieldset class="stack">
      <legend class="hint">{t("falsifier.loads")}</legend>
      {terms.map((term, at) => (
        <TermFields
          key={at}
          number={at + 1}
          term={term}
          canBeRemoved={terms.length > 1}
          onChange={(changed) => set(terms.map((other, place) => (place === at ? changed : other)))}
          onRemove={() => set(terms.filter((_, place) => place !== at))}
        />
      ))}
      <button
        type="button"
        class="button"
        disabled={terms.length >= 8}
        onClick={() => set([...terms, terms.at(-1) as TermForm])}
      >
        {t("falsifier.add")}
      </button>
    </fieldset>
  );
}

/** Bounds and objective of a search: a built-in adversary, changed, or text. */
export function Start() {
  const known = adversaries.value;
  const first = known[0];
  const [source, setSource] = useState<string | null>(null);
  const [changed, setChanged] = useState<Partial<AdversaryForm>>({});
  const [own, setOwn] = useState("");
  const [law, setLaw] = useState("");
  const [runs, setRuns] = useState(RUNS);
  const [seed, setSeed] = useState(0);
  if (first === undefined) return null;
  const chosen = source ?? first.name;
  const from = known.find(({ name }) => name === chosen);
  const form = from && { ...readForm(from.definition as Adversary), ...changed };
  const tested = law || (form?.law ?? "");
  const change = (more: Partial<AdversaryForm>) => setChanged({ ...changed, ...more });
  return (
    <form
      class="surface card stack form"
      onSubmit={(event) => {
        event.preventDefault();
        const definition = form
          ? { definition: writeForm({ ...form, law: tested }) }
          : { text: own };
        void startNewSearch({ ...definition, ...(law !== "" && { law }), runs, seed });
      }}
    >
      <h3>{t("falsifier.begin")}</h3>
      <SourceField
        label={t("falsifier.adversary")}
        own={{ name: t("falsifier.own"), label: t("falsifier.text") }}
        templates={known}
        source={chosen}
        text={own}
        onChange={(name, written) => {
          setSource(name);
          setOwn(written);
          setChanged({});
        }}
      />
      <SelectField
        label={t("falsifier.law")}
        value={tested}
        options={[...(form ? [] : [""]), ...usableLaws.value.map(({ name }) => name)]}
        name={(name) => (name === "" ? t("studies.asInStudy") : titleOf(name))}
        onChoose={setLaw}
      />
      {form && (
        <>
          <SelectField
            label={t("falsifier.cost")}
            value={form.cost}
            options={HARMS}
            name={(cost) => t(`falsifier.costs.${cost}`)}
            title={t("falsifier.costHint")}
            onChoose={(cost) => change({ cost })}
          />
          <Base form={form} onChange={change} />
          <Loads form={form} onChange={change} />
          <div class="pair">
            <NumberField
              label={t("falsifier.off")}
              unit="%"
              title={t("falsifier.offHint")}
              min={0}
              max={90}
              value={form.offPercent}
              onInput={(offPercent) => change({ offPercent })}
            />
            <NumberField
              label={t("falsifier.duration")}
              unit="s"
              min={0.1}
              max={60}
              value={form.durationS}
              onInput={(durationS) => change({ durationS })}
            />
          </div>
        </>
      )}
      <div class="pair">
        <NumberField
          label={t("falsifier.runs")}
          isInteger
          title={t("falsifier.runsHint")}
          min={1}
          max={100_000}
          value={runs}
          onInput={setRuns}
        />
        <NumberField label={t("falsifier.seed")} isInteger min={0} value={seed} onInput={setSeed} />
      </div>
      <div class="row">
        <button type="submit" class="button is-primary" disabled={isBusy.value !== ""}>
          {t("falsifier.search")}
        </button>
      </div>
    </form>
  );
}
