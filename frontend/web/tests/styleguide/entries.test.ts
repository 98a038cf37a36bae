import { expect, it } from "vitest";
import "../browserless";
import config from "../../vite.config";

const SHEETS = import.meta.glob("../../src/{parts,primitives}.css", {
  query: "?raw",
  import: "default",
  eager: true,
}) as Record<string, string>;

it("shows every class of the parts and primitives", async () => {
  const { LAYOUT, PARTS, TEXT } = await import("../../styleguide/entries");
  const shown = [...LAYOUT, ...TEXT, ...PARTS].flatMap(({ name }) => name.split(" "));
  const sheets = Object.values(SHEETS);
  expect(sheets).toHaveLength(2);
  const selectors = sheets.join("").replaceAll(/\/\*[\s\S]*?\*\/|\{[^{}]*\}/g, "");
  const classes = [...selectors.matchAll(/\.([a-z-]+)/g)].map(([, name]) => name);
  const own = classes.filter((name) => !name?.startsWith("is-"));
  expect([...new Set(own)].sort()).toEqual(shown.sort());
});

it("is not in the built page", () => {
  const { build } = config({ mode: "production", command: "build" });
  expect(build?.rolldownOptions?.input).toEqual(["index.html", "docs.html"]);
});
