/** The English texts of the page, by area. Other languages have the same keys. */
import { actuatorsText } from "./actuators";
import { armText } from "./arm";
import { benchText } from "./bench";
import { classroomText, gradesText } from "./classroom";
import { controlText } from "./control";
import { controlsText, identificationText, lawsText } from "./controls";
import { designText } from "./design";
import { falsifierText } from "./falsifier";
import { formsText, jobsText, tuningText } from "./jobs";
import { keysText, sceneText, scriptText } from "./lab";
import { leaderboardText } from "./leaderboard";
import { learningText } from "./learning";
import { measuredText } from "./measured";
import { metricsText } from "./metrics";
import { numbersText } from "./numbers";
import { pageText } from "./page";
import { plotsText } from "./plots";
import { rankingText } from "./ranking";
import { realismText } from "./realism";
import { replayText } from "./replay";
import { runsText } from "./runs";
import { stabilityText } from "./stability";
import { studiesText } from "./studies";

export const en = {
  ...pageText,
  ...numbersText,
  ...actuatorsText,
  ...armText,
  ...plotsText,
  ...controlsText,
  ...controlText,
  ...classroomText,
  ...rankingText,
  ...benchText,
  ...designText,
  ...falsifierText,
  ...stabilityText,
  ...gradesText,
  ...leaderboardText,
  ...learningText,
  ...lawsText,
  ...sceneText,
  ...keysText,
  ...identificationText,
  ...jobsText,
  ...formsText,
  ...realismText,
  ...runsText,
  ...scriptText,
  ...studiesText,
  ...tuningText,
  measured: measuredText,
  metrics: metricsText,
  replay: replayText,
} as const;
