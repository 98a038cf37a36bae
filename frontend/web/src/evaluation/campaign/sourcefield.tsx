import { SelectField } from "../../core/widgets/form";

export const OWN = "";

interface SourceFieldProps {
  label: string;
  /** Name of the choice of an own text, and label of the text. */
  own: { name: string; label: string };
  templates: readonly { name: string; title: string; text: string }[];
  /** Name of a template, or `OWN`. */
  source: string;
  text: string;
  onChange: (source: string, text: string) => void;
}

/** Select a template of the lab, or an own text, which begins as the last template. */
export function SourceField(props: SourceFieldProps) {
  const { label, own, templates, source, text, onChange } = props;
  const template = templates.find(({ name }) => name === source);
  return (
    <>
      <SelectField
        label={label}
        value={source}
        options={[...templates.map(({ name }) => name), OWN]}
        name={(name) => (name === OWN ? own.name : name)}
        onChoose={(name) =>
          onChange(name, name === OWN && text === "" ? (template?.text ?? "") : text)
        }
      />
      {source === OWN ? (
        <label>
          <span>{own.label}</span>
          <textarea
            rows={12}
            spellcheck={false}
            value={text}
            onInput={({ currentTarget }) => onChange(OWN, currentTarget.value)}
          />
        </label>
      ) : (
        <p class="hint">{template?.title}</p>
      )}
    </>
  );
}
