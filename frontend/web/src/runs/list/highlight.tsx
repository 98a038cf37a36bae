/** Marks the words of a search in a text. */
import { computed } from "@preact/signals";
import { search } from "./list";

interface Part {
  text: string;
  isFound: boolean;
}

const fold = (text: string): string => text.normalize("NFC").toLowerCase();

export const searchedWords = computed(() =>
  fold(search.value)
    .split(/\s+/)
    .filter((word) => word !== ""),
);

/** The text in parts, found and not; unmarked if case folding changes its length. */
export function findWords(text: string, words: readonly string[]): Part[] {
  const folded = fold(text);
  if (words.length === 0 || folded.length !== text.length) return [{ text, isFound: false }];
  const isFound = new Array<boolean>(text.length).fill(false);
  for (const word of words) {
    for (let at = folded.indexOf(word); at >= 0; at = folded.indexOf(word, at + 1)) {
      isFound.fill(true, at, at + word.length);
    }
  }
  const parts: Part[] = [];
  for (let from = 0, to = 1; to <= text.length; to++) {
    if (to < text.length && isFound[to] === isFound[from]) continue;
    parts.push({ text: text.slice(from, to), isFound: isFound[from] as boolean });
    from = to;
  }
  return parts;
}

const BEFORE = 16;

/**
 * The part of a long note that is shown: from shortly before the first word that was found in it.
 */
export function excerpt(note: string, words: readonly string[]): string {
  const folded = fold(note);
  const places = words.map((word) => folded.indexOf(word)).filter((at) => at >= 0);
  const first = Math.min(...places);
  return places.length === 0 || first <= BEFORE ? note : `…${note.slice(first - BEFORE)}`;
}

/** A text with the search words marked. */
export function Highlighted({ children }: { children: string }) {
  return (
    <>
      {findWords(children, searchedWords.value).map((part, index) =>
        part.isFound ? <mark key={index}>{part.text}</mark> : part.text,
      )}
    </>
  );
}
