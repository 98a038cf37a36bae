import type { ComponentChildren } from "preact";
import { goTo, linkTo, type Place } from "./place";

interface PlaceLinkProps {
  to: Place;
  class?: string;
  title?: string;
  children: ComponentChildren;
}

/** A true link, which a new tab takes too; a plain click stays on the page. */
export function PlaceLink({ to, children, ...rest }: PlaceLinkProps) {
  return (
    <a
      href={linkTo(to)}
      {...rest}
      onClick={(event) => {
        if (event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey) return;
        event.preventDefault();
        goTo(to);
      }}
    >
      {children}
    </a>
  );
}
