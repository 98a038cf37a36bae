/** A symbol or label as the server writes it, with a subscript lowered: a_min, σ_d. */
export function MathSymbol({ text }: { text: string }) {
  const [, base = text, index = "", rest = ""] = /^([^\s_])_(\w+)(.*)$/u.exec(text) ?? [];
  return (
    <>
      {base}
      {index && <sub>{index}</sub>}
      {rest}
    </>
  );
}
