import { vi } from "vitest";

/** The simulated browser for the modules under test. kept: content of its storage. */
export function stubBrowser(kept: Record<string, string> = {}): { store: Map<string, string> } {
  const store = new Map(Object.entries(kept));
  const storage = {
    getItem: (key: string) => store.get(key) ?? null,
    setItem: (key: string, value: string) => void store.set(key, value),
    removeItem: (key: string) => void store.delete(key),
  };
  const target = new EventTarget();
  vi.stubGlobal(
    "window",
    Object.assign(target, { matchMedia: () => ({ matches: false, addEventListener: () => {} }) }),
  );
  vi.stubGlobal("sessionStorage", storage);
  vi.stubGlobal("localStorage", storage);
  vi.stubGlobal("document", { baseURI: "http://lab/", documentElement: { dataset: {} } });
  vi.stubGlobal("location", { search: "" });
  return { store };
}
