import { isPrivate } from "../api/client";
import { text } from "../text/en";

/** Says that the page shows a private session, and leads back. */
export function PrivateBanner() {
  if (!isPrivate) return null;
  return (
    <aside class="private-banner" aria-label={text.private.label}>
      <p>
        <strong>{text.private.title}</strong> {text.private.text}
      </p>
      <a class="button" href={location.pathname}>
        {text.private.back}
      </a>
    </aside>
  );
}
