import type { ComponentChildren } from "preact";
import { useEffect, useId, useRef, useState } from "preact/hooks";

interface PopupProps {
  /** What the button says, or shows with `name` as its name. */
  button: ComponentChildren;
  name?: string;
  title: string;
  class: string;
  popupClass?: string;
  isDisabled?: boolean;
  children: (close: () => void) => ComponentChildren;
}

const GAP_PX = 4;

/** Below its button, or above it, or over it where neither has room enough; never over the status
 * bar, where the quick stop is. */
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
  const wanted = left + width > innerWidth - GAP_PX ? right - width : left;
  popup.style.left = `${Math.max(GAP_PX, wanted)}px`;
}

/** A button and what it opens; Esc or a press elsewhere closes it and gives the focus back. */
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
    const put = () => place(box, below);
    const follow = new ResizeObserver(put);
    follow.observe(box);
    window.addEventListener("resize", put);
    return () => {
      follow.disconnect();
      window.removeEventListener("resize", put);
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
        class={`popup ${popupClass ?? ""}`}
        role="dialog"
        aria-label={name ?? title}
        onToggle={(event) => setOpen((event as unknown as ToggleEvent).newState === "open")}
      >
        {isOpen && children(() => popup.current?.hidePopover())}
      </div>
    </>
  );
}
