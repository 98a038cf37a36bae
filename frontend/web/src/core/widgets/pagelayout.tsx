/** Full pages, with or without a side column, and the boxes of their forms. */

import type { ComponentChildren } from "preact";
import type { Law } from "../api/types";
import { usableLaws } from "../state/laws";
import { t } from "../text/t";
import { ErrorLine } from "./form";

interface PageProps {
  title: string;
  /** Description of the page in one sentence. */
  lead: string;
  /** Why the last request was rejected; empty without one. */
  problem: string;
  /** Content at the end of the title's line. */
  aside?: ComponentChildren;
  class?: string;
  children: ComponentChildren;
}

/** A full page: title, error of the last request, content. */
export function Page({ title, lead, problem, aside, children, class: look = "" }: PageProps) {
  return (
    <main class={`page column scroller ${look}`} aria-label={title}>
      <div class="spread page-head">
        <div>
          <h2>{title}</h2>
          <p class="muted" translate>
            {lead}
          </p>
        </div>
        {aside}
      </div>
      <ErrorLine>{problem}</ErrorLine>
      {children}
    </main>
  );
}

/** A page with a side column for forms and saved items. */
export function PageWithForm({ side, children, ...page }: PageProps & { side: ComponentChildren }) {
  return (
    <Page {...page}>
      <div class="desk">
        <aside class="stack">{side}</aside>
        {children}
      </div>
    </Page>
  );
}

/** Marks a result that comes with the lab, and is shown until the user has one. */
export const Example = () => (
  <span class="tag" title={t("jobs.exampleHint")}>
    {t("jobs.example")}
  </span>
);

interface BoxesProps {
  offered: readonly { name: string; title: string }[];
  chosen: readonly string[];
  /** Whether the box of this name cannot be changed. */
  isFixed?: (name: string) => boolean;
  onChange: (chosen: readonly string[]) => void;
}

/** Select any of several items, one check box each. */
export function Boxes({ offered, chosen, isFixed, onChange }: BoxesProps) {
  return (
    <div class="boxes">
      {offered.map(({ name, title }) => (
        <label key={name} class="line check">
          <input
            type="checkbox"
            checked={chosen.includes(name)}
            disabled={isFixed?.(name)}
            onChange={() =>
              onChange(
                chosen.includes(name)
                  ? chosen.filter((chosenName) => chosenName !== name)
                  : [...chosen, name],
              )
            }
          />
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

/** Select any of the installed laws, one check box each. */
export function LawBoxes({ laws, onChange }: LawBoxesProps) {
  return <Boxes offered={usableLaws.value} chosen={laws} onChange={onChange} />;
}
