import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";

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
