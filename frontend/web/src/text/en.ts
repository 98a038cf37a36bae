/** Every word of the page, by area. */
import { benchText } from "./bench";
import { controlsText } from "./controls";
import { keysText } from "./keys";
import { pageText } from "./page";
import { plotsText } from "./plots";

export const text = {
  ...pageText,
  ...plotsText,
  ...controlsText,
  ...benchText,
  ...keysText,
} as const;
