/** The class code that a QR code put behind the # of the address, where no server sees it. */

const FRAGMENT = "#join=";

/** Takes the code out of the address, so that nobody reads it there; "" where there is none. */
export function takeCode(): string {
  if (!location.hash.startsWith(FRAGMENT)) return "";
  const code = decodeURIComponent(location.hash.slice(FRAGMENT.length));
  history.replaceState(history.state, "", location.pathname + location.search);
  return code;
}
