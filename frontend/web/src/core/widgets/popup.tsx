import type { ComponentChildren } from "preact";
import { useEffect, useId, useRef, useState } from "preact/hooks";

interface PopupProps {
  /** Label of the button, or its icon with `name` as its accessible name. */
  button: ComponentChildren;
  name?: string;
  title: string;
  class: string;
  popupClass?: string;
  isDisabled?: boolean;
  children: (close: () => void) => ComponentChildren;
}

const GAP_PX = 4;

/**
 * Below its button, or above it, or over it if neither has enough space; never over the status bar,
 * which has the quick stop.
 */
function place(popup: HTMLElement, button: HTMLElement): void {
  const { left, right, top, bottom } = button.getBoundingClientRect();
  const { innerWidth, innerHeight } = window;
  const statusbar = getComputedStyle(document.documentElement).getPropertyValue("--statusbar");
  const floor = innerHeight - Number.parseFloat(statusbar) - GAP_PX;
  popup.style.maxHeight = `${floor - GAP_PX}px`;
  const { offsetWidth: width, offsetHeight: height } = popup;
  const fits = [bottom + GAP_PX, top - GAP_PX - height, floor - height].find(
    (y) => y >= GAP_PX && y + height <= floor,
  );
  popup.style.top = `${fits ?? GAP_PX}px`;
  const preferredLeft = left + width > innerWidth - GAP_PX ? right - width : left;
  popup.style.left = `${Math.max(GAP_PX, preferredLeft)}px`;
}

/** A button and its popup; Esc or a click elsewhere closes it and returns the focus. */
export function Popup({
  button,
  name,
  title,
  class: look,
  popupClass,
  isDisabled,
  children,
}: PopupProps) {
  const id = useId();
  const popup = useRef<HTMLDivElement>(null);
  const opener = useRef<HTMLButtonElement>(null);
  const [isOpen, setOpen] = useState(false);
  useEffect(() => {
    const [box, below] = [popup.current, opener.current];
    if (!isOpen || box === null || below === null) return;
    const updatePosition = () => place(box, below);
    const follow = new ResizeObserver(updatePosition);
    follow.observe(box);
    window.addEventListener("resize", updatePosition);
    return () => {
      follow.disconnect();
      window.removeEventListener("resize", updatePosition);
    };
  }, [isOpen]);
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
        disabled={isDisabled}
      >
        {button}
      </button>
      <div
        ref={popup}
        id={id}
        popover="auto"
        class={`floating stack small popup ${popupClass ?? ""}`}
        role="dialog"
        aria-label={name ?? title}
        onToggle={(event) => setOpen((event as unknown as ToggleEvent).newState === "open")}
      >
        {isOpen && children(() => popup.current?.hidePopover())}
      </div>
    </>
  );
}
