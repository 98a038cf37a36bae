import type { RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { receivedCount } from "../state/session";

const PERIOD_MS = 100;

/**
 * An element whose text follows the samples, ten times per second, without rendering a component.
 */
export function useLiveText<T extends HTMLElement>(read: () => string): RefObject<T | null> {
  const element = useRef<T>(null);
  useEffect(() => {
    let shownCount = -1;
    const write = () => {
      if (element.current === null || shownCount === receivedCount.peek()) return;
      shownCount = receivedCount.peek();
      const next = read();
      if (element.current.textContent !== next) element.current.textContent = next;
    };
    write();
    const timer = setInterval(write, PERIOD_MS);
    return () => clearInterval(timer);
  }, [read]);
  return element;
}
