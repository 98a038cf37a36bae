import type { ComponentChildren } from "preact";
import { useId, useLayoutEffect, useRef } from "preact/hooks";
import { text } from "../text/en";
import { closeOnEscape } from "./escape";

interface PanelProps {
  title: string;
  class: string;
  /** Stands between the title and the button that closes. */
  beside?: ComponentChildren;
  onClose: () => void;
  children: ComponentChildren;
}

/** Lies over the page and leaves it in reach; gives the focus back when it closes. */
export function Panel({ title, class: look, beside, onClose, children }: PanelProps) {
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
        {beside}
        <button type="button" class="button panel-close" onClick={onClose}>
          {text.panel.close}
        </button>
      </div>
      {children}
    </dialog>
  );
}
