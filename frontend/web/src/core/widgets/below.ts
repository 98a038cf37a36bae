import type { RefObject } from "preact";
import { useEffect, useState } from "preact/hooks";

/**
 * The sections of a scrolling list whose headings are below its lower edge.
 *
 * parts: their selector. cover: height of that edge that is covered, px.
 */
export function useBelow(
  list: RefObject<HTMLElement | null>,
  parts: string,
  cover = 0,
): readonly HTMLElement[] {
  const [below, setBelow] = useState<readonly HTMLElement[]>([]);
  useEffect(() => {
    const element = list.current;
    if (element === null) return;
    const find = () => {
      const end = element.getBoundingClientRect().bottom - cover;
      const hiddenParts = [...element.querySelectorAll<HTMLElement>(parts)].filter(
        (part) => (headingOf(part)?.getBoundingClientRect().bottom ?? 0) > end,
      );
      const isSame = (before: readonly HTMLElement[]) =>
        before.length === hiddenParts.length &&
        before.every((item, at) => item === hiddenParts[at]);
      setBelow((before) => (isSame(before) ? before : hiddenParts));
    };
    const resizing = new ResizeObserver(find);
    for (const item of [element, ...element.querySelectorAll(parts)]) resizing.observe(item);
    element.addEventListener("scroll", find, { passive: true });
    return () => {
      resizing.disconnect();
      element.removeEventListener("scroll", find);
    };
  }, [list, parts, cover]);
  return below;
}

export const headingOf = (part: HTMLElement): HTMLElement | null =>
  part.querySelector<HTMLElement>("h2, h3");

/** Scroll to a section and focus it. */
export function goTo(part: HTMLElement): void {
  part.scrollIntoView({ block: "start" });
  headingOf(part)?.focus({ preventScroll: true });
}
