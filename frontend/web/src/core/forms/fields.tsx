/** The fields of a request: one control per field of its schema, in that order. */
import type { ComponentChildren, VNode } from "preact";
import { useContext } from "preact/hooks";
import {
  changeKind,
  firstOf,
  isNumber,
  kindsOf,
  readField,
  type Schema,
  type Values,
} from "../schema";
import { t } from "../text/t";
import { ErrorLine, SelectField } from "../widgets/form";
import {
  FieldError,
  type FieldProps,
  Flag,
  NumberOf,
  Numbers,
  Select,
  Selection,
  TextOf,
} from "./controls";
import type { Live } from "./live";
import { describeRest, FormContext, type Offered, type RequestForm } from "./request";

/** The choices of a field, or of the items of a list; null if it is free. */
function useOffered(name: string, schema: Schema): Offered | null {
  const { choices } = useContext(FormContext);
  const values = (schema.items ?? schema).enum;
  return (
    choices[name] ??
    values?.map((value) => ({ name: value, title: schema.choices?.[value] ?? value })) ??
    null
  );
}

export function Field(props: FieldProps) {
  const field = readField(props.schema);
  const offered = useOffered(props.name, field);
  const parts = Object.values(field.properties ?? {}).map(readField);
  const areBounds = parts.length > 0 && parts.every((part) => part.isOptional && isNumber(part));
  if (field.prefixItems) return <Numbers {...props} />;
  if (field.items && offered) return <Selection {...props} offered={offered} />;
  if (field.items) return <List {...props} />;
  if (field.oneOf) return <Kind {...props} />;
  if (areBounds || field.type === "object") {
    return areBounds || !field.properties ? <Entries {...props} /> : <Group {...props} />;
  }
  if (isNumber(field)) return <NumberOf {...props} />;
  if (field.type === "boolean") return <Flag {...props} />;
  return offered ? <Select {...props} offered={offered} /> : <TextOf {...props} />;
}

function Group(props: FieldProps) {
  return (
    <fieldset class="stack">
      <legend class="hint">{props.schema.title}</legend>
      <Fields {...props} value={(props.value ?? firstOf(readField(props.schema))) as Values} />
      <FieldError path={props.path} schema={props.schema} />
    </fieldset>
  );
}

/** A value of one of several kinds: the kind, and its fields. */
function Kind({ path, schema, value, onChange }: FieldProps) {
  const kinds = kindsOf(readField(schema));
  const held = value as Values;
  const kind = kinds.get(String(held.kind));
  return (
    <Fields
      schema={kind?.schema ?? {}}
      path={path}
      value={held}
      onChange={onChange}
      lead={
        <SelectField
          label={t("forms.kind")}
          value={String(held.kind)}
          options={[...kinds.keys()]}
          name={(name) => kinds.get(name)?.title ?? name}
          onChoose={(name) => onChange(changeKind(held, kinds.get(name)?.schema ?? {}))}
        />
      }
    />
  );
}

/** Items that can be added and removed; a new one begins as the last. */
export function List({ name, path, schema, value, onChange }: FieldProps) {
  const { items = {}, title, minItems = 0, maxItems } = readField(schema);
  const { title: itemTitle = t("forms.item") } = items;
  const held = (value ?? []) as readonly unknown[];
  return (
    <fieldset class="stack">
      <legend class="hint">{title}</legend>
      {held.map((item, at) => (
        <fieldset key={at} class="stack sunken form-item">
          <legend>
            {itemTitle} {at + 1}
          </legend>
          <Field
            name={name}
            path={`${path}[${at}]`}
            schema={items}
            value={item}
            onChange={(next) => onChange(held.map((other, place) => (place === at ? next : other)))}
          />
          {held.length > minItems && (
            <button
              type="button"
              class="button"
              aria-label={t("forms.removeItem", { item: itemTitle, number: at + 1 })}
              onClick={() => onChange(held.filter((_, place) => place !== at))}
            >
              {t("forms.remove")}
            </button>
          )}
        </fieldset>
      ))}
      <FieldError path={path} schema={schema} />
      <button
        type="button"
        class="button"
        disabled={held.length >= (maxItems ?? Number.POSITIVE_INFINITY)}
        onClick={() => onChange([...held, held.at(-1) ?? firstOf(items)])}
      >
        {t("forms.add", { item: itemTitle })}
      </button>
    </fieldset>
  );
}

/** A number for each of the names that are chosen. */
export function Entries(props: FieldProps) {
  const { name, path, value = {}, onChange } = props;
  const { choices } = useContext(FormContext);
  const { properties, additionalProperties, parts = [], ...field } = readField(props.schema);
  const numbers = value as Values;
  const schemas: Readonly<Record<string, Schema>> =
    properties ??
    Object.fromEntries(
      (choices[name] ?? []).map((choice) => [
        choice.name,
        { ...(additionalProperties as Schema), ...choice },
      ]),
    );
  const offered = Object.entries(schemas).map(([key, { title = key }]) => ({ name: key, title }));
  const titleOf = (key: string) => [schemas[key]?.title ?? key, ...parts].join(", ");
  const choose = (keys: readonly string[]) =>
    onChange(Object.fromEntries(keys.map((key) => [key, numbers[key]])));
  return (
    <>
      <Selection
        {...props}
        schema={field}
        offered={offered}
        value={Object.keys(numbers)}
        onChange={(keys) => (keys === undefined ? onChange(undefined) : choose(keys as string[]))}
      />
      {Object.entries(numbers).map(([key, number]) => (
        <Field
          key={key}
          name={key}
          path={`${path}.${key}`}
          schema={{ ...required(schemas[key] ?? {}), title: titleOf(key) }}
          value={number}
          onChange={(next) => onChange({ ...numbers, [key]: next })}
        />
      ))}
    </>
  );
}

/** A chosen name needs its number. */
function required(schema: Schema): Schema {
  const { anyOf: _, isOptional: __, ...own } = readField(schema);
  return own;
}

interface FieldsProps {
  schema: Schema;
  value: Values;
  onChange: (value: Values) => void;
  path?: string;
  /** Shown in place of a field: null for a field that the user does not set here. */
  replace?: Readonly<Record<string, ComponentChildren>>;
  /** In front of the first field. */
  lead?: VNode;
  /** Not in pairs: in a row, or in a narrow panel. */
  isRow?: boolean;
}

/** Every field of an object but its kind; two short ones are next to each other. */
export function Fields(props: FieldsProps) {
  const { schema, value, onChange, path = "", replace = {}, lead, isRow = false } = props;
  const { choices } = useContext(FormContext);
  const groups: ComponentChildren[][] = lead ? [[lead]] : [];
  let isOpen = lead !== undefined;
  for (const [name, field] of Object.entries(readField(schema).properties ?? {})) {
    if (name === "kind") continue;
    const own = readField(field);
    const isShort = isNumber(own) || own.enum || (own.type === "string" && choices[name]);
    const control =
      name in replace ? (
        replace[name]
      ) : (
        <Field
          key={name}
          name={name}
          path={path === "" ? name : `${path}.${name}`}
          schema={field}
          value={value[name]}
          onChange={(next) => onChange({ ...value, [name]: next })}
        />
      );
    const last = groups.at(-1);
    const joins = !isRow && isShort && isOpen && last?.length === 1 && !(name in replace);
    if (joins) last.push(control);
    else if (control !== null) groups.push([control]);
    isOpen = Boolean(isShort) && !(name in replace);
  }
  return (
    <>
      {groups.map((group, at) =>
        group.length > 1 ? (
          <div class="pair" key={at}>
            {group}
          </div>
        ) : (
          group
        ),
      )}
    </>
  );
}

/** Numbers of the session, sent as soon as they are changed. */
export const LiveFields = ({
  schema,
  value,
  ...live
}: Live & { schema: Schema; value: object }) => (
  <FormContext.Provider value={{ body: {}, choices: {}, refusal: null, live }}>
    <Fields schema={schema} value={value as Values} onChange={() => undefined} isRow />
  </FormContext.Provider>
);

type RequestFieldsProps = Pick<FieldsProps, "schema" | "replace" | "isRow"> & { form: RequestForm };

/** The fields of a request. */
export const RequestFields = ({ form, ...fields }: RequestFieldsProps) => (
  <FormContext.Provider value={form}>
    <Fields {...fields} value={form.body} onChange={form.set} />
    <Rest />
  </FormContext.Provider>
);

/** What no field shows; rendered after the fields. */
const Rest = () => <ErrorLine>{describeRest(useContext(FormContext))}</ErrorLine>;
