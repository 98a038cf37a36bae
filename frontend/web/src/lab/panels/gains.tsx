import { type GainsRequest, putGains } from "../../core/api/client";
import type { Configuration } from "../../core/api/types";
import { standing } from "../../core/state/meanwhile";
import { text } from "../../core/text/en";
import { DesignSummary } from "../design/summary";
import { Field } from "./field";

type GainsState = Configuration["gains"];
type CoefficientsKey = "position_coefficients" | "stiffness_coefficients";

interface CoefficientsProps {
  which: CoefficientsKey;
  symbol: string;
  gains: GainsState;
}

function Coefficients({ which, symbol, gains }: CoefficientsProps) {
  const values = gains[which];
  const send = (changed: number, value: number) => {
    const request: GainsRequest = {
      [which]: standing("gains", gains)[which].map((held, index) =>
        index === changed ? value : held,
      ),
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
  return (
    <>
      <DesignSummary />
      <details class="more">
        <summary>{text.gains.coefficients}</summary>
        <Coefficients which="position_coefficients" symbol="q" gains={gains} />
        <Coefficients which="stiffness_coefficients" symbol="σ" gains={gains} />
      </details>
    </>
  );
}
