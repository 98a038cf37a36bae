/** A page with what was kept and begun at its side, and what is looked at beside it. */
import type { ComponentChildren } from "preact";
import type { Law } from "../api/types";
import { usableLaws } from "../state/laws";

interface DeskProps {
  title: string;
  lead: string;
  problem: string;
  side: ComponentChildren;
  children: ComponentChildren;
  class?: string;
}

export function Desk({ title, lead, problem, side, children, class: look = "" }: DeskProps) {
  return (
    <main class={`page ${look}`} aria-label={title}>
      <div class="page-head">
        <h2>{title}</h2>
        <p>{lead}</p>
      </div>
      <p class="problem" role="alert" hidden={problem === ""}>
        {problem}
      </p>
      <div class="desk-body">
        <aside class="desk-side">{side}</aside>
        {children}
      </div>
    </main>
  );
}

interface BoxesProps {
  offered: readonly { name: string; title: string }[];
  chosen: readonly string[];
  onChange: (chosen: readonly string[]) => void;
}

/** Any of some things, each a box. */
export function Boxes({ offered, chosen, onChange }: BoxesProps) {
  return (
    <div class="desk-boxes">
      {offered.map(({ name, title }) => (
        <label key={name}>
          <input
            type="checkbox"
            checked={chosen.includes(name)}
            onChange={() =>
              onChange(
                chosen.includes(name) ? chosen.filter((one) => one !== name) : [...chosen, name],
              )
            }
          />{" "}
          {title}
        </label>
      ))}
    </div>
  );
}

interface LawBoxesProps {
  laws: readonly Law[];
  onChange: (laws: readonly Law[]) => void;
}

/** Any of the laws that are installed, each a box. */
export function LawBoxes({ laws, onChange }: LawBoxesProps) {
  return <Boxes offered={usableLaws.value} chosen={laws} onChange={onChange} />;
}
