import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import de from "../../../src/core/text/de.json";
import { en } from "../../../src/core/text/en";
import { chooseLanguage } from "../../../src/core/text/language";
import zh from "../../../src/core/text/zh-Hans.json";

type Leaves = Map<string, string>;

function leaves(value: object, path = "", texts: Leaves = new Map()): Leaves {
  for (const [key, inner] of Object.entries(value)) {
    if (typeof inner === "string") texts.set(path + key, inner);
    else leaves(inner, `${path}${key}.`, texts);
  }
  return texts;
}

const ENGLISH = leaves(en);
const CATALOGS = { de: leaves(de), zh: leaves(zh) };
const PLURAL = /_(one|other)$/;
const englishOf = (key: string) => ENGLISH.get(key) ?? ENGLISH.get(key.replace(PLURAL, "_other"));
/** Names of the values; their formats may differ. */
const valuesOf = (text: string) =>
  [...text.matchAll(/\{\{(\w+)[^}]*\}\}/g)].map(([, name]) => name).sort();

describe.each(Object.entries(CATALOGS))("%s", (language, catalog) => {
  test("has the keys and the values of the English texts", () => {
    for (const [key, text] of catalog) {
      const english = englishOf(key);
      expect(english, `${language}: ${key}`).toBeDefined();
      expect([...new Set(valuesOf(text))], key).toEqual([...new Set(valuesOf(english ?? ""))]);
      expect(text.trim(), key).not.toBe("");
    }
  });

  test("is complete where it is translated", () => {
    const areas = new Set([...catalog.keys()].map((key) => key.split(".")[0]));
    const isTranslated = (key: string) =>
      catalog.has(key) || catalog.has(key.replace(/_one$/, "_other"));
    const missing = [...ENGLISH.entries()].filter(
      ([key, text]) =>
        areas.has(key.split(".")[0]) && !isTranslated(key) && !/^deg(·s)?$/.test(text),
    );
    expect(missing.map(([key]) => key)).toEqual([]);
  });

  test("has every plural form of its language", () => {
    const { pluralCategories } = new Intl.PluralRules(language).resolvedOptions();
    for (const key of catalog.keys()) {
      if (!PLURAL.test(key)) continue;
      for (const form of pluralCategories) {
        expect([...catalog.keys()]).toContain(key.replace(PLURAL, `_${form}`));
      }
    }
  });
});

test.each([
  [["de-AT", "en"], "de"],
  [["fr-FR", "de", "en"], "de"],
  [["en-GB", "de"], "en"],
  [["zh-CN"], "zh-Hans"],
  [["zh"], "zh-Hans"],
  [["zh-Hans-SG"], "zh-Hans"],
  [["ZH-SG"], "zh-Hans"],
  [["zh-TW"], "en"],
  [["zh-Hant"], "en"],
  [["zh-HK", "zh", "en"], "en"],
  [["zh-TW", "zh-CN"], "zh-Hans"],
  [["not a tag", "*", "", "de"], "de"],
  [["fr"], "en"],
  [[], "en"],
])("a browser that prefers %j has the language %s", (tags, language) => {
  expect(chooseLanguage(tags)).toBe(language);
});

describe("the texts of a page", () => {
  beforeEach(() => void vi.resetModules());
  afterEach(() => void vi.unstubAllGlobals());

  const open = async (languages: readonly string[], stored: string | null = null) => {
    vi.stubGlobal("navigator", { languages });
    vi.stubGlobal("localStorage", { getItem: () => stored });
    return (await import("../../../src/core/text/t")).t;
  };

  test("are those of the browser's language, with its plural forms", async () => {
    const t = await open(["de-CH", "en"]);
    expect(t("transport.speed")).toBe("Tempo");
    expect([1, 2].map((count) => t("laws.matching", { count }))).toEqual([
      "1 Regelgesetz",
      "2 Regelgesetze",
    ]);
  });

  test("are those of the language that was chosen in the menu", async () => {
    expect((await open(["zh-SG"], "de"))("transport.speed")).toBe("Tempo");
  });

  test("have numbers with the decimal sign of the language, also in fields", async () => {
    const t = await open(["de"]);
    const { formatInput, formatNumber, formatTime, roundTo } = await import(
      "../../../src/core/units"
    );
    const { parseNumber } = await import("../../../src/core/readnumber");
    expect(t("transport.seconds", { seconds: 0.5 })).toBe("0,5 s");
    expect([formatNumber(-1.25), formatInput(28.6479, 6), formatTime(75.25)]).toEqual([
      "\u22121,25",
      "28,6479",
      "1:15,2",
    ]);
    expect(roundTo(28.6479, 3)).toBe(28.6);
    expect(["28,648", "0.5", "1.25", "12,5"].map(parseNumber)).toEqual(
      [28.648, 0.5, 1.25, 12.5].map((value) => ({ value })),
    );
    expect(parseNumber("1.234")).toEqual({
      reason: "„1.234“ kann 1234 oder 1,234 bedeuten. Geben Sie eines davon ein.",
    });
  });

  test("a list of steps is read as it was written", async () => {
    await open(["de"]);
    const { readLevels, writeLevels } = await import("../../../src/lab/panels/shapes");
    const list = writeLevels({ low: 1.125, high: 20.5, hold: 1.125, count: 2 });
    expect(list).toBe("0; 1,125\n1,125; 20,5\n2,25; 1,125");
    expect(readLevels("stiffness", list)).toMatchObject({ time_s: [0, 1.125, 2.25] });
  });

  test("are English where a translation is missing", async () => {
    const t = await open(["zh-CN"]);
    expect(t("laws.matching", { count: 1 })).toBe("1 个控制律");
    expect(t("runs.count", { count: 1 })).toBe("1 run");
    expect(t("studies.state", { done: 1234, rows: 5000 })).toBe("1,234 of 5,000 runs");
  });
});
