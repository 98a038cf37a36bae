/** How the server knows this tab again: a text that nobody guesses, not shown to others. */

const KEY = "svsa.client";

/** 128 random bits as text. */
export function drawText(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** What a reload keeps; a tab that was made from this one by duplication finds nothing. */
function takeKept(): string | null {
  try {
    const kept = sessionStorage.getItem(KEY);
    sessionStorage.removeItem(KEY);
    return kept;
  } catch {
    return null;
  }
}

export const client = takeKept() ?? drawText();

window.addEventListener("pagehide", () => {
  try {
    sessionStorage.setItem(KEY, client);
  } catch {
    // A tab that keeps nothing is another client after a reload.
  }
});
window.addEventListener("pageshow", (event) => {
  if (event.persisted) takeKept();
});
