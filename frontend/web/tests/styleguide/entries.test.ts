import { expect, it } from "vitest";
import "../browserless";
import config from "../../vite.config";

const SHEETS = import.meta.glob("../../src/**/*.css", {
  query: "?raw",
  import: "default",
  eager: true,
}) as Record<string, string>;
/** Classes of one place each: uPlot's selection, and the button of the load. */
const ELSEWHERE = ["u-select", "load-button"];

function classesOf(css: string): string[] {
  const selectors = css.replaceAll(/\/\*[\s\S]*?\*\/|\{[^{}]*\}/g, "");
  const names = [...selectors.matchAll(/\.([a-z-]+)/g)].map(([, name]) => name as string);
  return names.filter((name) => !name.startsWith("is-") && !ELSEWHERE.includes(name));
}

it("shows every class of base.css, and no class without a rule", async () => {
  const { LAYOUT, PARTS, TEXT } = await import("../../styleguide/entries");
  const shown = [...LAYOUT, ...TEXT, ...PARTS].flatMap(({ name }) => name.split(" "));
  const base = classesOf(SHEETS["../../src/base.css"] ?? "");
  expect(base.length).toBeGreaterThan(30);
  expect(base.filter((name) => !shown.includes(name))).toEqual([]);
  const all = new Set(Object.values(SHEETS).flatMap(classesOf));
  expect(shown.filter((name) => !all.has(name))).toEqual([]);
});

it("is not in the built page", () => {
  const { build } = config({ mode: "production", command: "build" });
  expect(build?.rolldownOptions?.input).toEqual(["index.html", "docs.html"]);
});
