/** A symbol, a letter without letters before it and its index: a_min, σ_d, ŵ_2. */
const SYMBOL = /(?<![\p{L}\d_])(\p{L}\p{M}?)_(\w+)/u;

/** Text as the server writes it, with the index of each symbol lowered. */
export function MathSymbol({ text }: { text: string }) {
  // A split at two groups: text, letter, index, text, …
  const parts = text.split(SYMBOL);
  return <>{parts.map((part, number) => (number % 3 === 2 ? <sub>{part}</sub> : part))}</>;
}
