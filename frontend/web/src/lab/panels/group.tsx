import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";
import { EquationButton } from "../../core/equations/equation";
import type { Topic } from "../../core/equations/equations";

interface GroupProps {
  title: string;
  /** What the equation behind the group is of. */
  topic?: Topic;
  /** Stands in the line of the title. */
  aside?: ComponentChildren;
  children: ComponentChildren;
}

export function Group({ title, topic, aside, children }: GroupProps) {
  const id = useId();
  return (
    <section class="group" aria-labelledby={id}>
      <div class="group-head">
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
