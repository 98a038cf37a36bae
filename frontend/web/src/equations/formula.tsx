import { useEffect, useRef } from "preact/hooks";

/** The typesetter and its fonts, fetched when the first formula is looked at. */
const loading: { katex?: Promise<typeof import("katex")> } = {};

function loadKatex(): Promise<typeof import("katex")> {
  loading.katex ??= Promise.all([import("katex"), import("katex/dist/katex.min.css")]).then(
    ([katex]) => katex,
  );
  return loading.katex;
}

/** A formula, typeset, and as MathML for screen readers. */
export function Formula({ tex }: { tex: string }) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    let isWanted = true;
    void loadKatex().then(({ default: katex }) => {
      if (isWanted && host.current) katex.render(tex, host.current, { displayMode: true });
    });
    return () => {
      isWanted = false;
    };
  }, [tex]);
  return <div class="formula" ref={host} />;
}
