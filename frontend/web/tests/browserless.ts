/**
 * Browser globals that modules of the page read on import; imported first, because Node has none.
 */
import { vi } from "vitest";

const storage = { getItem: () => null, setItem: () => {}, removeItem: () => {} };
const media = { matches: false, addEventListener: () => {} };
vi.stubGlobal("sessionStorage", storage);
vi.stubGlobal("localStorage", storage);
vi.stubGlobal("window", Object.assign(new EventTarget(), { matchMedia: () => media }));
vi.stubGlobal("document", {
  baseURI: "http://lab/",
  documentElement: { dataset: {} },
  addEventListener: () => {},
});
vi.stubGlobal("location", { search: "", pathname: "/", href: "http://lab/" });
