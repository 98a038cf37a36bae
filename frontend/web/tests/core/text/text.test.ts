import ts from "typescript";
import { describe, expect, it } from "vitest";
import { en } from "../../../src/core/text/en";

const SPOKEN = new Set(["aria-label", "aria-description", "title", "placeholder", "alt"]);
/** Symbols of units are the same in every language. */
const UNITS = new Set(["deg", "Hz"]);
/** Two words, the first with a capital: a visible text, not a class or a key. */
const SENTENCE = /^[A-Z][a-z]+,? [a-zA-Z]/;

/** Reading every file takes seconds on a busy machine. */
const PATIENCE_MS = 60_000;

const files = import.meta.glob<string>(
  ["../../../src/**/*.{ts,tsx}", "!../../../src/core/text/**", "!../../../src/**/*.d.ts"],
  { query: "?raw", import: "default", eager: true },
);

function isSpoken(node: ts.Node): boolean {
  if (ts.isJsxText(node)) return /\p{L}{2}/u.test(node.text) && !UNITS.has(node.text.trim());
  if (!ts.isStringLiteralLike(node) && !ts.isTemplateHead(node)) return false;
  if (SENTENCE.test(node.text) && !node.getText().includes("\\")) return true;
  const owner = node.parent;
  return ts.isJsxAttribute(owner) && SPOKEN.has(owner.name.getText()) && /\p{L}/u.test(node.text);
}

function findTexts([file, content]: [string, string]): string[] {
  const root = ts.createSourceFile(file, content, ts.ScriptTarget.Latest, true, ts.ScriptKind.TSX);
  const found: string[] = [];
  const visit = (node: ts.Node): void => {
    if (isSpoken(node)) found.push(`${file}: ${node.getText().trim()}`);
    ts.forEachChild(node, visit);
  };
  visit(root);
  return found;
}

function leaves(value: unknown, path: string): [string, unknown][] {
  if (typeof value !== "object" || value === null) return [[path, value]];
  return Object.entries(value).flatMap(([key, inner]) => leaves(inner, `${path}.${key}`));
}

describe("text", () => {
  it("has no empty entry", () => {
    for (const [path, value] of leaves(en, "en")) {
      expect(value, path).toBeTypeOf("string");
      expect(value, path).not.toBe("");
    }
  });

  it(
    "is the only place of what people read, so that it can be translated",
    () => {
      const contents = Object.entries(files);
      expect(contents.length).toBeGreaterThan(100);
      expect(contents.flatMap(findTexts)).toEqual([]);
    },
    PATIENCE_MS,
  );
});
