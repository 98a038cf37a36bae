/** A page with what was kept and begun at its side, and what is looked at beside it. */
import type { ComponentChildren } from "preact";

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
