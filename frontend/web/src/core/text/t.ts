/**
 * `t("transport.run")`: a text of the page by its key, with named values and plural forms
 * (`key_one`, `key_other`). TypeScript compares keys and values with the English texts, which also
 * replace what is not translated yet.
 */
import i18next, { type FormatFunction, type FormatterModule, type ResourceKey } from "i18next";
import { en } from "./en";
import { language, localize } from "./language";

declare module "i18next" {
  interface CustomTypeOptions {
    resources: { translation: typeof en };
    nsSeparator: false;
    interpolationFormatTypeMap: { lowercase: string };
  }
}

/** A failure to load leaves the English texts. */
async function loadTranslation(): Promise<ResourceKey> {
  try {
    if (language === "de") return (await import("./de.json")).default;
    if (language === "zh-Hans") return (await import("./zh-Hans.json")).default;
  } catch {
    // The page works without it.
  }
  return {};
}

/** `{{runs, number}}`: with separators of thousands; `{{name, lowercase}}`: within a sentence. */
const format: FormatFunction = (value, name) => {
  if (name === "number") return value.toLocaleString(language);
  if (name === "lowercase") return value.toLowerCase();
  return typeof value === "number" ? localize(String(value)) : value;
};

const formatter: FormatterModule = {
  type: "formatter",
  init: () => undefined,
  add: () => undefined,
  addCached: () => undefined,
  format,
};

void i18next.use(formatter).init({
  lng: language,
  fallbackLng: "en",
  load: "currentOnly",
  resources: {
    ...(language !== "en" && { [language]: { translation: await loadTranslation() } }),
    en: { translation: en },
  },
  initAsync: false,
  nsSeparator: false,
  interpolation: { escapeValue: false, alwaysFormat: true },
});

export const { t } = i18next;

/** The language of the texts of an area if it is not translated: a screen reader needs it. */
export const languageOf = (area: keyof typeof en): "en" | undefined =>
  i18next.getResource(language, "translation", area) === undefined ? "en" : undefined;
