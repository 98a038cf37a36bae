import type { ComponentChildren } from "preact";
import { goTo, linkTo, type Place } from "./place";

interface PlaceLinkProps {
  to: Place;
  class?: string;
  title?: string;
  /** It leads to the page that is shown. */
  isHere?: boolean;
  /** The key that does the same, in the words of `aria-keyshortcuts`. */
  shortcut?: string | undefined;
  /** After a click that stayed on the page. */
  onGo?: () => void;
  children: ComponentChildren;
}

/** A true link, which a new tab takes too; a plain click stays on the page. */
export function PlaceLink({ to, isHere, shortcut, onGo, children, ...rest }: PlaceLinkProps) {
  return (
    <a
      href={linkTo(to)}
      aria-current={isHere ? "page" : undefined}
      aria-keyshortcuts={shortcut}
      {...rest}
      onClick={(event) => {
        if (event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey) return;
        event.preventDefault();
        goTo(to);
        onGo?.();
      }}
    >
      {children}
    </a>
  );
}
