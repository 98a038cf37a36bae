import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { t } from "../core/text/t";
import { ErrorLine } from "../core/widgets/form";

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

/** A page or panel outside the first file, shown when it has loaded. */
export function LazyPage({ name, isPanel = false }: { name: keyof Pages; isPanel?: boolean }) {
  useEffect(() => {
    if (pages.peek() === null) void fetchPages();
  }, []);
  const Page = pages.value?.[name];
  if (Page) return <Page />;
  const reason = isMissing.value ? t("pages.missing") : "";
  return isPanel ? (
    <ErrorLine>{reason}</ErrorLine>
  ) : (
    <main class="empty" aria-live="assertive">
      {reason}
    </main>
  );
}
