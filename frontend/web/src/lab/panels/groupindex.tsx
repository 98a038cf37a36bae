import type { RefObject } from "preact";
import { text } from "../../core/text/en";
import { goTo, headingOf, useBelow } from "../../core/widgets/below";

/** The groups that are scrolled out of sight below; a touch goes there. */
export function GroupIndex({ groups }: { groups: RefObject<HTMLElement | null> }) {
  const below = useBelow(groups, ".group");
  return (
    <nav class="group-index" aria-label={text.controls.index}>
      {below.map((group) => {
        const heading = headingOf(group);
        return (
          <a
            key={heading?.id}
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
