import { type GainsRequest, putGains } from "../api/client";
import type { Configuration } from "../api/types";
import { text } from "../text/en";
import { bandwidthOf, isAtOnePlace } from "./bandwidth";
import { Field } from "./field";
import type { SliderRange } from "./scale";

type GainsState = Configuration["gains"];
type CoefficientsKey = "position_coefficients" | "stiffness_coefficients";

const UNIT = "rad/s";
const POSITION: SliderRange = { min: 5, max: 200, logarithmic: true };
const STIFFNESS: SliderRange = { min: 5, max: 200, logarithmic: true };

const shortest = (value: number) => Number(value.toPrecision(10));

interface CoefficientsProps {
  which: CoefficientsKey;
  symbol: string;
  values: readonly number[];
}

function Coefficients({ which, symbol, values }: CoefficientsProps) {
  const send = (changed: number, value: number) => {
    const request: GainsRequest = {
      [which]: values.map((held, index) => (index === changed ? value : held)),
    };
    return putGains(request);
  };
  return (
    <>
      {values.map((value, index) => (
        <Field
          key={`${which}.${index}`}
          name={`gains.${which}.${index}`}
          label={text.gains.coefficient(symbol, index)}
          unit={text.gains.coefficientUnit(values.length - index)}
          value={value}
          send={(next) => send(index, next)}
        />
      ))}
    </>
  );
}

export function Gains({ gains }: { gains: GainsState }) {
  const { position_coefficients: position, stiffness_coefficients: stiffness } = gains;
  const isSpread = !isAtOnePlace(position) || !isAtOnePlace(stiffness);
  return (
    <>
      <p class="hint">{text.gains.explanation}</p>
      <Field
        name="gains.position"
        label={text.gains.position}
        labelRest={text.gains.bandwidth}
        unit={UNIT}
        value={shortest(bandwidthOf(position))}
        range={POSITION}
        send={(p) => putGains({ position_poles_rad_per_s: [-p, -p, -p, -p] })}
      />
      <Field
        name="gains.stiffness"
        label={text.gains.stiffness}
        labelRest={text.gains.bandwidth}
        unit={UNIT}
        value={shortest(bandwidthOf(stiffness))}
        range={STIFFNESS}
        send={(p) => putGains({ stiffness_poles_rad_per_s: [-p, -p] })}
      />
      {isSpread && <p class="hint">{text.gains.spread}</p>}
      <details class="more">
        <summary>{text.gains.coefficients}</summary>
        <Coefficients which="position_coefficients" symbol="q" values={position} />
        <Coefficients which="stiffness_coefficients" symbol="σ" values={stiffness} />
      </details>
    </>
  );
}
