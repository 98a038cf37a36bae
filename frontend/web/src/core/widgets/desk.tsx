/** Pages of their own, with or without a side, and the boxes of their forms. */

import type { ComponentChildren } from "preact";
import type { Law } from "../api/types";
import { usableLaws } from "../state/laws";
import { ErrorLine } from "./form";

interface PageProps {
  title: string;
  /** What the page shows, in a sentence. */
  lead: string;
  /** Why the last request was rejected; empty without one. */
  problem: string;
  /** Stands at the end of the title's line. */
  aside?: ComponentChildren;
  class?: string;
  children: ComponentChildren;
}

/** A page of its own: title, error of the last request, content. */
export function Page({ title, lead, problem, aside, children, class: look = "" }: PageProps) {
  return (
    <main class={`page ${look}`} aria-label={title}>
      <div class="spread page-head">
        <div>
          <h2>{title}</h2>
          <p class="muted">{lead}</p>
        </div>
        {aside}
      </div>
      <ErrorLine>{problem}</ErrorLine>
      {children}
    </main>
  );
}

/** A page with a side for what was begun and kept. */
export function Desk({ side, children, ...page }: PageProps & { side: ComponentChildren }) {
  return (
    <Page {...page}>
      <div class="desk">
        <aside class="stack">{side}</aside>
        {children}
      </div>
    </Page>
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
    <div class="boxes">
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
