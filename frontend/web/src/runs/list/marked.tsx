import { findWords, searchedWords } from "./found";

/** A text in which what was searched for is marked. */
export function Marked({ children }: { children: string }) {
  return (
    <>
      {findWords(children, searchedWords.value).map((part, index) =>
        part.isFound ? <mark key={index}>{part.text}</mark> : part.text,
      )}
    </>
  );
}
