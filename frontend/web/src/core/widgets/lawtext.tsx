/** The user's own law, as a file or as text. */

import { useState } from "preact/hooks";
import { t } from "../text/t";
import { ErrorLine } from "./form";

export const MAX_BYTES = 1 << 16;

const countBytes = (law: string): number => new TextEncoder().encode(law).length;

/** Reason why a text cannot be sent; "" if it can. */
export function findFault(law: string): string {
  const bytes = countBytes(law);
  return bytes > MAX_BYTES ? t("lawText.tooLong", { bytes, most: MAX_BYTES }) : "";
}

interface LawTextProps {
  law: string;
  onLaw: (law: string) => void;
  /** Name of the file that it was read from. */
  onFile?: (name: string) => void;
  /** An example to start from, and the label of its button; "" for none. */
  start: string;
  startWord: string;
}

export function LawText({ law, onLaw, onFile, start, startWord }: LawTextProps) {
  const [unreadable, setUnreadable] = useState("");
  const fault = unreadable || findFault(law);
  const take = async (file: File | undefined) => {
    setUnreadable("");
    if (file === undefined) return;
    if (file.size > MAX_BYTES) {
      setUnreadable(t("lawText.tooLong", { bytes: file.size, most: MAX_BYTES }));
      return;
    }
    try {
      onLaw(await file.text());
      onFile?.(file.name);
    } catch {
      setUnreadable(t("lawText.unreadable"));
    }
  };
  return (
    <>
      <label>
        <span>{t("lawText.file")}</span>
        <input
          type="file"
          accept=".py,text/x-python"
          onChange={({ currentTarget }) => void take(currentTarget.files?.[0])}
        />
      </label>
      <label>
        <span>{t("lawText.text")}</span>
        <textarea
          rows={14}
          spellcheck={false}
          autocomplete="off"
          wrap="off"
          value={law}
          onInput={({ currentTarget }) => {
            setUnreadable("");
            onLaw(currentTarget.value);
          }}
        />
        <small>{t("lawText.most", { bytes: MAX_BYTES })}</small>
      </label>
      {law === "" && start !== "" && (
        <button type="button" class="button" onClick={() => onLaw(start)}>
          {startWord}
        </button>
      )}
      <ErrorLine>{fault}</ErrorLine>
    </>
  );
}
