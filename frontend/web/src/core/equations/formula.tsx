import { useEffect, useRef } from "preact/hooks";

type Typesetter = typeof import("./typesetter");

/** The typesetter and its fonts, fetched when the first formula is looked at. */
const loading: { typesetter?: Promise<Typesetter> } = {};

function loadTypesetter(): Promise<Typesetter> {
  loading.typesetter ??= import("./typesetter");
  return loading.typesetter;
}

/** Puts a formula into an element, unless it is no longer wanted when the typesetter is there. */
async function typeset(
  element: HTMLElement,
  tex: string,
  isDisplayed: boolean,
  isWanted: () => boolean,
): Promise<void> {
  const { render } = await loadTypesetter();
  if (!isWanted()) return;
  render(tex, element, { displayMode: isDisplayed, throwOnError: false });
  if (!isDisplayed) return;
  // What scrolls is reached by keyboard; the width changes with the window.
  new ResizeObserver(() => {
    if (element.scrollWidth > element.clientWidth) element.tabIndex = 0;
    else element.removeAttribute("tabindex");
  }).observe(element);
}

/** A formula, typeset, and as MathML for screen readers. */
export function Formula({ tex }: { tex: string }) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    let isWanted = true;
    if (host.current) void typeset(host.current, tex, true, () => isWanted);
    return () => {
      isWanted = false;
    };
  }, [tex]);
  return <div class="formula" ref={host} />;
}

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
  return <div class="stack prose" ref={host} />;
}
