/** A group of settings, and the index of the groups below the panel. */
import type { ComponentChildren, RefObject } from "preact";
import { useId } from "preact/hooks";
import { EquationButton } from "../../core/equations/equation";
import type { Topic } from "../../core/equations/equations";
import { t } from "../../core/text/t";
import { goTo, headingOf, useBelow } from "../../core/widgets/below";

interface GroupProps {
  title: string;
  /** Key of the group's equation. */
  topic?: Topic | undefined;
  /** Content in the line of the title. */
  aside?: ComponentChildren;
  children: ComponentChildren;
}

export function Group({ title, topic, aside, children }: GroupProps) {
  const id = useId();
  return (
    <section class="stack tight group" aria-labelledby={id}>
      <div class="row tight group-head">
        <h2 id={id} tabIndex={-1}>
          {title}
        </h2>
        {topic && <EquationButton topic={topic} />}
        {aside}
      </div>
      {children}
    </section>
  );
}

/** The groups that are scrolled out of view below; a click scrolls there. */
export function GroupIndex({ groups }: { groups: RefObject<HTMLElement | null> }) {
  const below = useBelow(groups, ".group");
  return (
    <nav class="group-index" aria-label={t("controls.index")}>
      {below.map((group) => {
        const heading = headingOf(group);
        return (
          <a
            key={heading?.id}
            class="quiet tiny strong nowrap"
            href={`#${heading?.id}`}
            onClick={(event) => {
              event.preventDefault();
              goTo(group);
            }}
          >
            {heading?.textContent}
          </a>
        );
      })}
    </nav>
  );
}
