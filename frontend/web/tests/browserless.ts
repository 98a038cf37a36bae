/** What modules of the page ask of a browser when they are read: imported first, there is none else. */
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
