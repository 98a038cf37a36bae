import { useEffect, useId, useRef, useState } from "preact/hooks";
import { text } from "../text/en";
import { EQUATIONS, type Equation, type Topic } from "./equations";
import { Formula } from "./formula";

const words = text.equations;
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
const GAP_PX = 6;

function EquationRow({ equation }: { equation: Equation }) {
  const { number, tex, printed, note } = equation;
  return (
    <div class="equation">
      {number && <span class="equation-number">{words.number(number)}</span>}
      <Formula tex={tex} />
      {printed && (
        <div class="equation-printed">
          <span class="equation-label">{words.printed}</span>
          <Formula tex={printed} />
          <p>{words.corrected}</p>
        </div>
      )}
      {note && <p>{words.notes[note]}</p>}
    </div>
  );
}

export function EquationCard({ topic }: { topic: Topic }) {
  return (
    <div class="equation-card">
      {EQUATIONS[topic].map((equation) => (
        <EquationRow key={equation.tex} equation={equation} />
      ))}
    </div>
  );
}

/** Beside the button, on the side with more room, inside the window. */
function place(card: HTMLElement, button: HTMLElement): void {
  const { left, bottom, top } = button.getBoundingClientRect();
  const { offsetWidth: width, offsetHeight: height } = card;
  const isBelow = bottom + GAP_PX + height <= window.innerHeight || bottom < top;
  const y = isBelow ? bottom + GAP_PX : top - GAP_PX - height;
  card.style.left = `${Math.max(GAP_PX, Math.min(left, window.innerWidth - width - GAP_PX))}px`;
  card.style.top = `${Math.max(GAP_PX, Math.min(y, window.innerHeight - height - GAP_PX))}px`;
}

/** The symbol of a quantity; pressing it opens the equations behind it. */
export function EquationButton({ topic }: { topic: Topic }) {
  const id = useId();
  const button = useRef<HTMLButtonElement>(null);
  const card = useRef<HTMLDivElement>(null);
  const [isOpen, setOpen] = useState(false);
  useEffect(() => {
    const [box, opener] = [card.current, button.current];
    if (!isOpen || box === null || opener === null) return;
    const follow = new ResizeObserver(() => place(box, opener));
    follow.observe(box);
    return () => follow.disconnect();
  }, [isOpen]);
  const [symbol, index] = SYMBOLS[topic].split("_");
  const name = words.open(words.topics[topic]);
  return (
    <>
      <button
        ref={button}
        type="button"
        class="symbol"
        popovertarget={id}
        aria-label={`${name}, ${symbol}${index ?? ""}`}
        aria-haspopup="dialog"
        title={name}
      >
        <i aria-hidden="true">
          {symbol}
          {index && <sub>{index}</sub>}
        </i>
      </button>
      <div
        ref={card}
        id={id}
        popover="auto"
        class="equation-popup"
        role="dialog"
        aria-label={name}
        onToggle={(event) => setOpen((event as unknown as ToggleEvent).newState === "open")}
      >
        {isOpen && <EquationCard topic={topic} />}
      </div>
    </>
  );
}
