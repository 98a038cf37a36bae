import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";

interface GroupProps {
  title: string;
  /** Stands in the line of the title. */
  aside?: ComponentChildren;
  children: ComponentChildren;
}

export function Group({ title, aside, children }: GroupProps) {
  const id = useId();
  return (
    <section class="group" aria-labelledby={id}>
      <div class="group-head">
        <h2 id={id}>{title}</h2>
        {aside}
      </div>
      {children}
    </section>
  );
}
