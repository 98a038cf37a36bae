import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { t } from "../../core/text/t";

interface CopyButtonProps {
  /** The text to copy; null if it could not be made, which is reported elsewhere. */
  read: () => string | Promise<string | null>;
  class?: string;
  label?: string;
  hint?: string;
  disabled?: boolean;
  children: ComponentChildren;
}

const SHOWN_MS = 2000;

/** Copies a text, and confirms it for a moment. */
export function CopyButton({ read, label, hint, disabled, children, ...rest }: CopyButtonProps) {
  const [message, setMessage] = useState("");
  const timer = useRef(0);
  useEffect(() => () => clearTimeout(timer.current), []);
  const copy = async () => {
    const content = await read();
    if (content === null) return;
    setMessage((await copyText(content)) ? t("script.copied") : t("script.notCopied"));
    clearTimeout(timer.current);
    timer.current = window.setTimeout(() => setMessage(""), SHOWN_MS);
  };
  return (
    <>
      <button
        type="button"
        class={rest.class ?? "button"}
        aria-label={label}
        title={hint}
        disabled={disabled}
        onClick={() => void copy()}
      >
        {message === "" ? children : <span aria-hidden="true">✓ {message}</span>}
        {message !== "" && <span class="visually-hidden">{children}</span>}
      </button>
      <span class="visually-hidden" role="status">
        {message}
      </span>
    </>
  );
}

/** False if the browser does not allow copying. */
export async function copyText(content: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(content);
    return true;
  } catch {
    return false;
  }
}

export function saveText(content: string, fileName: string): void {
  const address = URL.createObjectURL(new Blob([content], { type: "text/x-python" }));
  const link = document.createElement("a");
  link.href = address;
  link.download = fileName;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address));
}
