/**
 * `t("transport.run")`: a text of the page by its key, with named values and plural forms
 * (`key_one`, `key_other`). TypeScript compares keys and values with the English texts.
 */
import i18next, { type FormatFunction, type FormatterModule } from "i18next";
import { en } from "./en";

declare module "i18next" {
  interface CustomTypeOptions {
    resources: { translation: typeof en };
    nsSeparator: false;
    interpolationFormatTypeMap: { lowercase: string };
  }
}

/** `{{runs, number}}`: with separators of thousands; `{{name, lowercase}}`: within a sentence. */
const format: FormatFunction = (value, name) =>
  name === "number" ? value.toLocaleString("en") : value.toLowerCase();

const formatter: FormatterModule = {
  type: "formatter",
  init: () => undefined,
  add: () => undefined,
  addCached: () => undefined,
  format,
};

void i18next.use(formatter).init({
  lng: "en",
  fallbackLng: "en",
  resources: { en: { translation: en } },
  initAsync: false,
  nsSeparator: false,
  interpolation: { escapeValue: false },
});

export const { t } = i18next;
