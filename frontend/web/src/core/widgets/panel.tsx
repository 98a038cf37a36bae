import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useId, useLayoutEffect, useRef } from "preact/hooks";
import { t } from "../text/t";

const open: (() => void)[] = [];

/** Call `close` on Escape until the returned function is called. */
export function closeOnEscape(close: () => void): () => void {
  open.push(close);
  return () => {
    const index = open.lastIndexOf(close);
    if (index >= 0) open.splice(index, 1);
  };
}

/** Close the newest panel; false if none is open, or the browser closes a popup. */
export function closeNewest(): boolean {
  const close = open.at(-1);
  if (close === undefined || document.querySelector(":popover-open") !== null) return false;
  close();
  return true;
}

interface PanelProps {
  title: string;
  class: string;
  /** Content between the title and the close button. */
  aside?: ComponentChildren;
  onClose: () => void;
  children: ComponentChildren;
}

/** A panel over the page, which stays operable; it returns the focus when it closes. */
export function Panel({ title, class: look, aside, onClose, children }: PanelProps) {
  const id = useId();
  const panel = useRef<HTMLDialogElement>(null);
  useLayoutEffect(() => {
    const before = document.activeElement as HTMLElement | null;
    panel.current?.show();
    const forget = closeOnEscape(onClose);
    return () => {
      forget();
      before?.focus();
    };
  }, [onClose]);
  return (
    <dialog
      ref={panel}
      class={`floating panel ${look}`}
      aria-labelledby={id}
      onKeyDown={(event) => {
        if (event.key === "Escape" && !event.shiftKey) onClose();
      }}
    >
      <div class="line loose panel-head">
        <h2 id={id}>{title}</h2>
        {aside}
        <button type="button" class="button end" onClick={onClose}>
          {t("panel.close")}
        </button>
      </div>
      {children}
    </dialog>
  );
}

interface PanelButtonProps {
  isOpen: Signal<boolean>;
  hint: string;
  /** Its name if it shows only an icon. */
  name?: string;
  /** Key of the same command, in the syntax of `aria-keyshortcuts`. */
  shortcut?: string;
  children: ComponentChildren;
}

/** Opens and closes a panel. */
export function PanelButton({ isOpen, hint, name, shortcut, children }: PanelButtonProps) {
  return (
    <button
      type="button"
      class={name === undefined ? "button" : "button is-icon"}
      aria-label={name}
      aria-haspopup="dialog"
      aria-expanded={isOpen.value}
      aria-keyshortcuts={shortcut}
      title={hint}
      onClick={() => {
        isOpen.value = !isOpen.peek();
      }}
    >
      {children}
    </button>
  );
}
