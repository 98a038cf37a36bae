/** The language of the page: chosen in the menu, or the first of the browser's that exists. */
import { readStored, store } from "../stored";

/** Each language by its own name. */
export const LANGUAGES = { en: "English", de: "Deutsch", "zh-Hans": "简体中文" } as const;
export type Language = keyof typeof LANGUAGES;

const STORE = "svsa.language";

function readLocale(tag: string): Intl.Locale | null {
  try {
    return new Intl.Locale(tag);
  } catch {
    return null;
  }
}

const isLanguage = (tag: string): tag is Language => Object.hasOwn(LANGUAGES, tag);

/**
 * The first of some language tags, the preferred ones first, in which the page exists; else English.
 *
 * The script decides: zh-CN, zh-SG and zh are Simplified Chinese. A reader of zh-TW or zh-Hant does
 * not get another script, also if the browser adds a plain zh to the list.
 */
export function chooseLanguage(tags: readonly string[]): Language {
  const rejected = new Set<string>();
  for (const tag of tags) {
    const locale = readLocale(tag);
    if (locale === null) continue;
    const { language, script } = locale.maximize();
    const match = language === "zh" ? `zh-${script}` : language;
    const isBare = tag.toLowerCase() === language;
    if (isLanguage(match) && !(isBare && rejected.has(match.slice(0, 2)))) return match;
    rejected.add(language);
  }
  return "en";
}

/** The page of an exported run is one file, with the English texts only. */
export const language: Language =
  import.meta.env.MODE === "replay"
    ? "en"
    : chooseLanguage([readStored(STORE) ?? "", ...(globalThis.navigator?.languages ?? [])]);

const DECIMAL_SIGN =
  new Intl.NumberFormat(language).formatToParts(0.5).find(({ type }) => type === "decimal")
    ?.value ?? ".";

/** Whether the page writes a decimal comma. */
export const hasDecimalComma = DECIMAL_SIGN === ",";

/** A number for the screen. Data, files, addresses and scripts keep the point. */
export const localize = (digits: string): string => digits.replace(".", DECIMAL_SIGN);

/** Texts are also read while modules load, so the page loads again. */
export function setLanguage(chosen: Language): void {
  store(STORE, chosen);
  location.reload();
}
