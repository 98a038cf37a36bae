/** Numbers of the session that are sent as soon as they are changed. */
import { useId } from "preact/hooks";
import type { SessionRequest } from "../api/client";
import { positionOf, type SliderRange, STEPS, valueAt } from "../scale";
import { quantityOfSchema, type Schema } from "../schema";
import { t } from "../text/t";
import { formatInput, roundTo } from "../units";
import { Problem } from "../widgets/form";
import { NumberField } from "../widgets/numberinput";
import { useServerNumber } from "./servernumber";

/** The requests that change the numbers of a form at once. */
export interface Live {
  /** Begins the names of its controls, unique on the page. */
  name: string;
  /** Built when it is sent, from the values that the session then has. */
  send: (path: string, value: unknown) => SessionRequest;
}

interface LiveNumberProps {
  name: string;
  /** In the request, as at the end of the names of violations. */
  path?: string;
  schema: Schema;
  /** SI, as in the request. */
  value: number;
  send: (value: number) => SessionRequest;
}

/** Moving the slider shows the value, releasing it sends it. */
export function LiveNumber({ name, path, schema, value, send }: LiveNumberProps) {
  const id = useId();
  const { symbol, title, about, slider: range, description } = schema;
  const { factor = 1, ...quantity } = quantityOfSchema(schema);
  const label = symbol ?? quantity.label;
  const { shown, drag, commit, release, edits } = useServerNumber({
    name,
    value: value * factor,
    send: (next) => send(next / factor),
  });
  const read = (input: HTMLInputElement) =>
    roundTo(valueAt(input.valueAsNumber, range as SliderRange), 3);
  return (
    <>
      {about && <p class="hint">{about}</p>}
      <NumberField
        {...quantity}
        label={label}
        labelRest={symbol && title}
        title={description}
        value={shown}
        step={range?.step}
        describedBy={id}
        onCommit={commit}
        slider={
          range && (
            <input
              type="range"
              min={0}
              max={STEPS}
              value={positionOf(shown, range)}
              aria-label={t("controls.slider", { label: symbol ? `${label} ${title}` : label })}
              aria-valuetext={`${formatInput(shown)} ${quantity.unit}`}
              aria-describedby={id}
              onInput={(event) => drag(read(event.currentTarget))}
              onChange={(event) => void release(read(event.currentTarget))}
            />
          )
        }
        below={
          <Problem id={id} control={name} path={path} quantity={{ ...quantity, factor, label }} />
        }
        container={edits}
      />
    </>
  );
}
