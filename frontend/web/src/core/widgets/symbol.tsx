/**
 * A symbol with its subscript: one letter without letters before it, and an index: a_min, σ_d, ŵ_2.
 */
const SYMBOL = /(?<![\p{L}\d_])(\p{L}\p{M}?)_(\w+)/u;

/** Text from the server, with the index of each symbol as subscript. */
export function MathSymbol({ text }: { text: string }) {
  // Splitting at two groups gives text, letter, index, text, …
  const parts = text.split(SYMBOL);
  return <>{parts.map((part, number) => (number % 3 === 2 ? <sub>{part}</sub> : part))}</>;
}
