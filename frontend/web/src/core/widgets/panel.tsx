import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useId, useLayoutEffect, useRef } from "preact/hooks";
import { text } from "../text/en";

const open: (() => void)[] = [];

/** Has Escape call `close` until the returned function is called. */
export function closeOnEscape(close: () => void): () => void {
  open.push(close);
  return () => {
    const index = open.lastIndexOf(close);
    if (index >= 0) open.splice(index, 1);
  };
}

/** Closes the newest; false where nothing is open, or a popup that the browser closes. */
export function closeNewest(): boolean {
  const close = open.at(-1);
  if (close === undefined || document.querySelector(":popover-open") !== null) return false;
  close();
  return true;
}

interface PanelProps {
  title: string;
  class: string;
  /** Stands between the title and the button that closes. */
  aside?: ComponentChildren;
  onClose: () => void;
  children: ComponentChildren;
}

/** Lies over the page and leaves it in reach; gives the focus back when it closes. */
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
      class={`panel ${look}`}
      aria-labelledby={id}
      onKeyDown={(event) => {
        if (event.key === "Escape" && !event.shiftKey) onClose();
      }}
    >
      <div class="panel-head">
        <h2 id={id}>{title}</h2>
        {aside}
        <button type="button" class="button end" onClick={onClose}>
          {text.panel.close}
        </button>
      </div>
      {children}
    </dialog>
  );
}

interface PanelButtonProps {
  isOpen: Signal<boolean>;
  hint: string;
  /** Its name, where it shows only a sign. */
  name?: string;
  /** The key that does the same, in the words of `aria-keyshortcuts`. */
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
