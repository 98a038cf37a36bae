import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { t } from "../core/text/t";

type Pages = typeof import("./otherpages");

const pages = signal<Pages | null>(null);
const isMissing = signal(false);

async function fetchPages(): Promise<void> {
  try {
    pages.value = await import("./otherpages");
  } catch {
    isMissing.value = true;
  }
}

/** A page outside the first file, shown when it has loaded. */
export function LazyPage({ name }: { name: keyof Pages }) {
  useEffect(() => {
    if (pages.peek() === null) void fetchPages();
  }, []);
  const Page = pages.value?.[name];
  return Page ? (
    <Page />
  ) : (
    <main class="muted waiting-page" aria-live="assertive">
      {isMissing.value && t("pages.missing")}
    </main>
  );
}
