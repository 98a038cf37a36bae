import { useEffect, useRef } from "preact/hooks";
import { typeset } from "./formula";

/** Text of the server's own making, in which elements of class `math` hold TeX. */
export function Prose({ html }: { html: string }) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    let isWanted = true;
    const box = host.current;
    if (box === null) return;
    box.innerHTML = html;
    for (const element of box.querySelectorAll<HTMLElement>(".math")) {
      const tex = (element.textContent ?? "").trim();
      void typeset(element, tex, element.classList.contains("block"), () => isWanted);
    }
    return () => {
      isWanted = false;
    };
  }, [html]);
  return <div class="prose" ref={host} />;
}
