import { useEffect, useRef } from "preact/hooks";

type Typesetter = typeof import("./typesetter");

/** KaTeX and its fonts, loaded when the first formula is shown. */
const loading: { typesetter?: Promise<Typesetter> } = {};

function loadTypesetter(): Promise<Typesetter> {
  loading.typesetter ??= import("./typesetter");
  return loading.typesetter;
}

/** Render a formula into an element, unless the element is gone when KaTeX has loaded. */
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
  // A scrolling formula must be reachable by keyboard; its width changes with the window.
  new ResizeObserver(() => {
    if (element.scrollWidth > element.clientWidth) element.tabIndex = 0;
    else element.removeAttribute("tabindex");
  }).observe(element);
}

/** A formula, with MathML for screen readers. */
export function Formula({ tex }: { tex: string }) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    let isWanted = true;
    if (host.current) void typeset(host.current, tex, true, () => isWanted);
    return () => {
      isWanted = false;
    };
  }, [tex]);
  return <div class="formula" translate={false} ref={host} />;
}

/** Text from the server in which elements of class `math` contain TeX. */
export function Prose({ html }: { html: string }) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    let isWanted = true;
    const box = host.current;
    if (box === null) return;
    box.innerHTML = html;
    for (const code of box.querySelectorAll("code")) code.translate = false;
    for (const element of box.querySelectorAll<HTMLElement>(".math")) {
      element.translate = false;
      const tex = (element.textContent ?? "").trim();
      void typeset(element, tex, element.classList.contains("block"), () => isWanted);
    }
    return () => {
      isWanted = false;
    };
  }, [html]);
  return <div class="stack prose" ref={host} />;
}
