import { putGains, putLaw } from "../../core/api/client";
import type { Configuration, SessionState } from "../../core/api/types";
import { LiveFields } from "../../core/forms/fields";
import { changeAt } from "../../core/schema";
import { perform } from "../../core/state/actions";
import { areJointsDifferent } from "../../core/state/arm";
import { currentValueOr } from "../../core/state/conflicts";
import { armOf } from "../../core/state/joints";
import { comparisonLaws } from "../../core/state/lanes";
import { lawOf, titleOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { Problem } from "../../core/widgets/form";
import { PanelButton } from "../../core/widgets/panel";
import { MathSymbol } from "../../core/widgets/symbol";
import { DesignSummary } from "../design/summary";
import { isOpen as isTuning } from "../tuning/tuning";
import { Compare } from "./compare";
import { Group } from "./group";
import { isIdentifying } from "./identification";
import { LawForm } from "./law";
import { LawPicker } from "./lawpicker";
import { isExact } from "./parameters";

/** `isBasic` leaves out the law and its comparison. */
export function Controller({ state, isBasic }: { state: SessionState; isBasic: boolean }) {
  const { law, gains } = state.configuration;
  const present = lawOf(law);
  return (
    <Group
      title={t("controller.title")}
      topic={isBasic ? undefined : "controller"}
      aside={
        <LawPicker
          label={`${t("controller.law")}: ${titleOf(law)}`}
          button={titleOf(law)}
          title={t("laws.choose")}
          value={law}
          onChoose={(next) => perform("controller.law", putLaw(next, comparisonLaws(next, state)))}
        />
      }
    >
      <p class="hint is-about">
        <MathSymbol text={present?.summary ?? ""} />
      </p>
      {isExact(state.configuration) && <p class="hint">{t("controller.exact")}</p>}
      {areJointsDifferent(state, ["law", "gains", "parameters"]) && (
        <p class="hint">{t("arm.differ")}</p>
      )}
      <Problem control="controller.law" />
      {!isBasic && (
        <>
          {present && !present.takes_gains && <LawForm law={present} state={state} />}
          {(!present || present.takes_gains) && <Gains gains={gains} />}
          {armOf(state) !== null ? (
            <p class="hint">{t("arm.searchesAlone")}</p>
          ) : (
            <div class="row tune-open">
              <PanelButton isOpen={isTuning} hint={t("tuning.openHint")}>
                {t("tuning.open")}
              </PanelButton>
              <PanelButton isOpen={isIdentifying} hint={t("identification.openHint")}>
                {t("identification.open")}
              </PanelButton>
            </div>
          )}
        </>
      )}
      <Compare state={state} />
    </Group>
  );
}

type GainsState = Configuration["gains"];

interface CoefficientsProps {
  which: "position_coefficients" | "stiffness_coefficients";
  symbol: string;
  gains: GainsState;
}

function Coefficients({ which, symbol, gains }: CoefficientsProps) {
  const { length } = gains[which];
  const prefixItems = gains[which].map((_, index) => ({
    type: "number",
    title: t("gains.coefficient", { index: "₀₁₂₃"[index] ?? "", symbol }),
    unit: length - index === 1 ? "1/s" : `1/s${"⁰¹²³⁴"[length - index]}`,
  }));
  return (
    <LiveFields
      name="gains"
      schema={{ properties: { [which]: { prefixItems } } }}
      value={gains}
      send={(path, value) =>
        putGains({ [which]: changeAt(currentValueOr("gains", gains), path, value)[which] })
      }
    />
  );
}

function Gains({ gains }: { gains: GainsState }) {
  return (
    <>
      <DesignSummary />
      <details class="more">
        <summary>{t("gains.coefficients")}</summary>
        <Coefficients which="position_coefficients" symbol="q" gains={gains} />
        <Coefficients which="stiffness_coefficients" symbol="σ" gains={gains} />
      </details>
    </>
  );
}
