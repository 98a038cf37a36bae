/** What Escape closes: of all that is open, the newest. */

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
