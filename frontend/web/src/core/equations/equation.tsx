import type { LawRow } from "../api/types";
import { laws } from "../state/laws";
import { session } from "../state/session";
import { t } from "../text/t";
import { Popup } from "../widgets/popup";
import { MathSymbol } from "../widgets/symbol";
import { EQUATIONS, type Equation, type Topic } from "./equations";
import { Formula } from "./formula";

const SYMBOLS: Record<Topic, string> = {
  motion: "q_d",
  position: "q",
  error: "e",
  stiffness: "σ",
  stiffnessError: "σ_e",
  torque: "u",
  disturbance: "ŵ",
  deflection: "φ",
  phase: "s",
  controller: "u",
  load: "w",
};

function EquationRow({ equation }: { equation: Equation }) {
  const { number, tex, printed, note } = equation;
  return (
    <div>
      {number && <span class="tag muted">{t("equations.number", { number })}</span>}
      <Formula tex={tex} />
      {printed && (
        <div class="note is-warn">
          <span class="tag strong tone">{t("equations.printed")}</span>
          <Formula tex={printed} />
          <p class="small" translate>
            {t("equations.corrected")}
          </p>
        </div>
      )}
      {note && (
        <p class="hint" translate>
          {t(`equations.notes.${note}`)}
        </p>
      )}
    </div>
  );
}

/** Equations: of the paper's two laws, and of the other laws in the current lanes. */
export function equationsOf(topic: Topic, controlling: readonly LawRow[]): readonly Equation[] {
  const printed = EQUATIONS[topic];
  if (topic !== "controller") return printed;
  const own = controlling.filter(({ name }) => !printed.some(({ law }) => law === name));
  return [
    ...own.map(({ title, equation }) => ({ tex: `\\text{${title}:}\\quad ${equation}` })),
    ...printed,
  ];
}

export function EquationCard({ topic }: { topic: Topic }) {
  const names = new Set(session.value?.lanes.map(({ law }) => law));
  const controlling = laws.value.filter(({ name, equation }) => equation && names.has(name));
  return (
    <div class="stack loose">
      {equationsOf(topic, controlling).map((equation) => (
        <EquationRow key={equation.tex} equation={equation} />
      ))}
    </div>
  );
}

/** The symbol of a quantity; a click shows its equations. */
export function EquationButton({ topic }: { topic: Topic }) {
  const title = t("equations.open", { topic: t(`equations.topics.${topic}`) });
  return (
    <Popup
      class="quiet symbol"
      popupClass="equation-popup"
      name={`${title}, ${SYMBOLS[topic].replace("_", "")}`}
      title={title}
      button={
        <i aria-hidden="true">
          <MathSymbol text={SYMBOLS[topic]} />
        </i>
      }
    >
      {() => <EquationCard topic={topic} />}
    </Popup>
  );
}
