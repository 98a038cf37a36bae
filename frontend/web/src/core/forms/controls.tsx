/** Controls for fields without fields of their own, with the reasons of a rejection. */
import { useContext, useId } from "preact/hooks";
import { quantityOfSchema, readField, type Schema } from "../schema";
import { explainViolation } from "../state/refusal";
import { t } from "../text/t";
import { ErrorLine, SelectField } from "../widgets/form";
import { NumberField } from "../widgets/numberinput";
import { Boxes } from "../widgets/pagelayout";
import { LiveNumber } from "./live";
import { FormContext, type Offered, violationsAt } from "./request";

export interface FieldProps {
  name: string;
  /** Where it is in the request, as in the names of violations. */
  path: string;
  schema: Schema;
  value: unknown;
  onChange: (value: unknown) => void;
}

/** Why the server rejected the value of a field; empty if it did not. */
function useReason(path: string, schema: Schema): string {
  const form = useContext(FormContext);
  const quantity = quantityOfSchema(schema);
  const reasons = violationsAt(form, path).map((violation) => {
    const { name, message } = violation;
    return quantity.factor === undefined && message.startsWith(name)
      ? quantity.label + message.slice(name.length)
      : explainViolation(violation, quantity);
  });
  return reasons.join(" ");
}

/** The same as a line after the field. */
export const FieldError = ({ path, schema }: { path: string; schema: Schema }) => (
  <ErrorLine>{useReason(path, schema)}</ErrorLine>
);

export function NumberOf(props: FieldProps) {
  const { live } = useContext(FormContext);
  const { path, schema, value } = props;
  if (live === undefined) return <TypedNumber {...props} />;
  return (
    <LiveNumber
      name={`${live.name}.${path}`}
      path={path}
      schema={schema}
      value={value as number}
      send={(next) => live.send(path, next)}
    />
  );
}

function TypedNumber({ path, schema, value, onChange }: FieldProps) {
  const id = useId();
  const reason = useReason(path, schema);
  const { isOptional, type, description, empty = "" } = readField(schema);
  const { factor = 1, ...quantity } = quantityOfSchema(readField(schema));
  return (
    <NumberField
      {...quantity}
      isInteger={type === "integer"}
      title={description}
      placeholder={empty}
      value={typeof value === "number" ? value * factor : null}
      onInput={(next) => onChange(next / factor)}
      {...(isOptional && { onEmpty: () => onChange(undefined) })}
      describedBy={id}
      isInvalid={reason !== ""}
      below={<ErrorLine id={id}>{reason}</ErrorLine>}
    />
  );
}

/** The numbers of a list of fixed length, such as the ends of a range. */
export function Numbers(props: FieldProps) {
  const { path, schema, value, onChange } = props;
  const id = useId();
  const reason = useReason(path, schema);
  const { live } = useContext(FormContext);
  const { prefixItems = [], parts = [], unit = "" } = schema;
  const numbers = value as readonly (number | undefined)[];
  if (live) {
    return prefixItems.map((item, at) => (
      <NumberOf
        {...props}
        key={at}
        path={`${path}[${at}]`}
        schema={{ unit, ...item }}
        value={numbers[at]}
      />
    ));
  }
  return (
    <>
      <div class="pair">
        {prefixItems.map((item, at) => {
          const title = parts[at] ?? String(at + 1);
          const { factor = 1, ...quantity } = quantityOfSchema({ ...item, unit, title });
          const held = numbers[at];
          return (
            <NumberField
              key={title}
              {...quantity}
              value={held === undefined ? null : held * factor}
              describedBy={id}
              isInvalid={reason !== ""}
              onInput={(next) =>
                onChange(
                  prefixItems.map((_, place) => (place === at ? next / factor : numbers[place])),
                )
              }
            />
          );
        })}
      </div>
      <ErrorLine id={id}>{reason}</ErrorLine>
    </>
  );
}

export function TextOf({ path, schema, value, onChange }: FieldProps) {
  const id = useId();
  const reason = useReason(path, schema);
  const { title, description, maxLength, empty, isOptional } = readField(schema);
  return (
    <>
      <label title={description}>
        <span>{title}</span>
        <input
          type="text"
          maxLength={maxLength}
          placeholder={empty}
          aria-invalid={reason !== ""}
          aria-describedby={id}
          value={String(value ?? "")}
          onInput={({ currentTarget: { value: next } }) =>
            onChange(next === "" && isOptional ? undefined : next)
          }
        />
      </label>
      <ErrorLine id={id}>{reason}</ErrorLine>
    </>
  );
}

export function Flag({ path, schema, value, onChange }: FieldProps) {
  return (
    <>
      <label class="line check" title={schema.description}>
        <input type="checkbox" checked={value === true} onChange={() => onChange(value !== true)} />
        {schema.title}
      </label>
      <FieldError path={path} schema={schema} />
    </>
  );
}

interface ChoiceProps extends FieldProps {
  offered: Offered;
}

export function Select({ path, schema, value, onChange, offered }: ChoiceProps) {
  const { title = "", description = "", isOptional, empty = "–" } = readField(schema);
  const held = String(value ?? "");
  const names = offered.map(({ name }) => name);
  return (
    <>
      <SelectField
        label={title}
        title={description}
        value={held}
        options={[...(isOptional || !names.includes(held) ? [""] : []), ...names]}
        name={(name) => offered.find((choice) => choice.name === name)?.title ?? empty}
        onChoose={(name) => onChange(name === "" ? undefined : name)}
      />
      <FieldError path={path} schema={schema} />
    </>
  );
}

/** More are behind a summary. */
const MAX_VISIBLE = 6;
const MAX_NAMED = 3;

/** Any of several choices, one check box each. */
export function Selection({ path, schema, value, onChange, offered }: ChoiceProps) {
  const { title = "", description, empty = "", minItems = 0, isOptional } = readField(schema);
  const chosen = (value ?? []) as readonly string[];
  const isLast = !isOptional && chosen.length <= minItems;
  const named = offered.filter(({ name }) => chosen.includes(name)).map((choice) => choice.title);
  const boxes = (
    <Boxes
      offered={offered}
      chosen={chosen}
      isFixed={(name) => isLast && chosen.includes(name)}
      onChange={(next) => onChange(isOptional && next.length === 0 ? undefined : next)}
    />
  );
  return (
    <div>
      {offered.length <= MAX_VISIBLE ? (
        <fieldset class="row" title={description}>
          <legend class="visually-hidden">{title}</legend>
          <span class="hint">{title}</span>
          {boxes}
        </fieldset>
      ) : (
        <details>
          <summary>
            {title}:{" "}
            {named.length > MAX_NAMED ? named.length : named.join(", ") || empty || t("forms.none")}
          </summary>
          <p class="hint">{description}</p>
          {boxes}
        </details>
      )}
      <FieldError path={path} schema={schema} />
    </div>
  );
}
