import { describe, expect, it } from "vitest";
import { text } from "../src/text/en";

const sources = import.meta.glob("../src/**/*.tsx", {
  query: "?raw",
  import: "default",
  eager: true,
}) as Record<string, string>;

function leaves(value: unknown, path = "text"): [string, unknown][] {
  if (typeof value !== "object" || value === null) return [[path, value]];
  return Object.entries(value).flatMap(([key, inner]) => leaves(inner, `${path}.${key}`));
}

describe("text", () => {
  it("has no empty entry", () => {
    for (const [path, value] of leaves(text)) {
      expect(["string", "function"], path).toContain(typeof value);
      expect(value, path).not.toBe("");
    }
  });

  it("is the only place of words: no component writes any between its tags", () => {
    expect(Object.keys(sources).length).toBeGreaterThan(10);
    for (const [path, source] of Object.entries(sources)) {
      const words = source.match(/^\s+[A-Z0-9]\w* [a-z]+[^;(){}<>=]*$/gm) ?? [];
      expect(words, path).toEqual([]);
    }
  });
});
