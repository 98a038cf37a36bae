/** All texts of the page, by area. */
import { actuatorsText } from "./actuators";
import { armText } from "./arm";
import { benchText } from "./bench";
import { classroomText, gradesText } from "./classroom";
import { controlText } from "./control";
import { controlsText, identificationText, lawsText } from "./controls";
import { designText } from "./design";
import { falsifierText } from "./falsifier";
import { jobsText, tuningText } from "./jobs";
import { keysText, sceneText, scriptText } from "./lab";
import { leaderboardText } from "./leaderboard";
import { learningText } from "./learning";
import { numbersText } from "./numbers";
import { pageText } from "./page";
import { plotsText } from "./plots";
import { rankingText } from "./ranking";
import { realismText } from "./realism";
import { runsText } from "./runs";
import { stabilityText } from "./stability";
import { studiesText } from "./studies";

export const text = {
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
  ...realismText,
  ...runsText,
  ...scriptText,
  ...studiesText,
  ...tuningText,
} as const;
