const DOI = /doi:(10\.\d{4,}\/\S+)$/;

/** What a law's source says, and the DOI at its end; "" where it names none. */
export function splitSource(source: string): { said: string; doi: string } {
  const found = DOI.exec(source);
  if (found === null) return { said: source, doi: "" };
  return { said: source.slice(0, found.index), doi: found[1] ?? "" };
}
