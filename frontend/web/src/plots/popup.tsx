import type { ComponentChildren } from "preact";
import { useId, useRef } from "preact/hooks";

interface PopupProps {
  /** What the button says, or shows with `name` as its name. */
  button: ComponentChildren;
  name?: string;
  title: string;
  class: string;
  children: (close: () => void) => ComponentChildren;
}

const GAP_PX = 4;

/** Below its button, or above it where there is more room; never out of sight. */
function place(popup: HTMLElement, button: HTMLElement): void {
  const { left, right, top, bottom } = button.getBoundingClientRect();
  const { innerWidth, innerHeight } = window;
  const isBelow = innerHeight - bottom >= Math.min(360, top);
  popup.style.maxHeight = `${(isBelow ? innerHeight - bottom : top) - 3 * GAP_PX}px`;
  popup.style.top = isBelow ? `${bottom + GAP_PX}px` : "auto";
  popup.style.bottom = isBelow ? "auto" : `${innerHeight - top + GAP_PX}px`;
  const width = popup.offsetWidth;
  const wanted = left + width > innerWidth - GAP_PX ? right - width : left;
  popup.style.left = `${Math.max(GAP_PX, wanted)}px`;
}

/** A button and what it opens; Esc or a press elsewhere closes it and gives the focus back. */
export function Popup({ button, name, title, class: look, children }: PopupProps) {
  const id = useId();
  const popup = useRef<HTMLDivElement>(null);
  const opener = useRef<HTMLButtonElement>(null);
  return (
    <>
      <button
        ref={opener}
        type="button"
        class={look}
        popovertarget={id}
        aria-label={name}
        aria-haspopup="dialog"
        title={title}
      >
        {button}
      </button>
      <div
        ref={popup}
        id={id}
        popover="auto"
        class="popup"
        role="dialog"
        aria-label={name ?? title}
        onToggle={(event) => {
          const isOpen = (event as unknown as ToggleEvent).newState === "open";
          if (isOpen && opener.current) place(event.currentTarget, opener.current);
        }}
      >
        {children(() => popup.current?.hidePopover())}
      </div>
    </>
  );
}
