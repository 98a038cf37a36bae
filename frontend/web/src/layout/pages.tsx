import { computed } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { isClass, isInstructor } from "../core/state/access";
import { session } from "../core/state/session";
import { LANGUAGES, type Language, language, setLanguage } from "../core/text/language";
import { t } from "../core/text/t";
import { Popup } from "../core/widgets/popup";
import { isOpen as isTuning } from "../lab/tuning/tuning";
import { isRunsPlace, type Place, PlaceLink, place } from "../runs/list/place";

type Page =
  | "lab"
  | "learn"
  | "runs"
  | "actuators"
  | "ranking"
  | "leaderboard"
  | "grades"
  | "studies"
  | "falsifier";
const PAGES: Readonly<Record<Page, Place>> = {
  lab: { kind: "lab" },
  learn: { kind: "learn", exercise: "", step: "" },
  runs: { kind: "list" },
  actuators: { kind: "actuators", actuator: "" },
  ranking: { kind: "ranking" },
  leaderboard: { kind: "leaderboard", entry: "" },
  grades: { kind: "grades" },
  studies: { kind: "studies", study: "", look: {} },
  falsifier: { kind: "falsifier", search: "", scenario: "", laws: [] },
};

/** In a class the instructor sees the grades of all; a student's own are in Learn. */
const shownPages = computed(() =>
  (Object.keys(PAGES) as Page[]).filter(
    (page) => page !== "grades" || !isClass.value || isInstructor.value,
  ),
);

const isOfActuators = computed(() => place.value.kind === "actuators");

/** A run and an overlay belong to the runs. */
const pageOf = (at: Place): Page => (isRunsPlace(at) ? "runs" : at.kind);

const EVALUATION: readonly Page[] = ["ranking", "leaderboard", "studies", "falsifier"];
const GROUPS: readonly (readonly Page[])[] = [["lab", "runs"], ["learn", "grades"], ["ranking"]];

interface TabProps {
  page: Page;
  isHere: boolean;
  name?: string;
}

function Tab({ page, isHere, name = t(`pages.names.${page}`) }: TabProps) {
  return (
    <li>
      <PlaceLink
        to={PAGES[page]}
        isHere={isHere}
        title={t(`pages.hints.${page}`)}
        shortcut={page === "runs" ? "o" : undefined}
      >
        {name}
      </PlaceLink>
    </li>
  );
}

/** Lab and runs, learning, evaluation; the last one opens the ranking. */
export function Tabs() {
  const here = pageOf(place.value);
  return (
    <nav class="line joined rigid tabs" aria-label={t("pages.tabs")}>
      {GROUPS.map((group) => (
        <ul key={group[0]} class="line menu">
          {group
            .filter((page) => shownPages.value.includes(page))
            .map((page) =>
              page === "ranking" ? (
                <Tab
                  key={page}
                  page={page}
                  isHere={EVALUATION.includes(here)}
                  name={t("pages.evaluation")}
                />
              ) : (
                <Tab key={page} page={page} isHere={page === here} />
              ),
            )}
        </ul>
      ))}
    </nav>
  );
}

/** The pages of the evaluation, in a row below the top bar. */
export function EvaluationTabs() {
  const here = pageOf(place.value);
  if (!EVALUATION.includes(here)) return null;
  return (
    <nav class="bar rigid tabs" aria-label={t("pages.evaluation")}>
      <ul class="row menu">
        {EVALUATION.map((page) => (
          <Tab key={page} page={page} isHere={page === here} />
        ))}
      </ul>
    </nav>
  );
}

function Entry({ name }: { name: "actuators" | "tune" | "guide" | "docs" }): ComponentChildren {
  return (
    <>
      <strong>{t(`pages.names.${name}`)}</strong>
      <small class="block">{t(`pages.hints.${name}`)}</small>
    </>
  );
}

/** Actuators, tuning, guide and API reference. */
export function PagesMenu() {
  return (
    <Popup
      button={
        <>
          <svg viewBox="0 0 16 16" aria-hidden="true">
            <path d="M1 2h14v2.5H1zM1 6.8h14v2.5H1zM1 11.5h14V14H1z" />
          </svg>
          <span class="menu-word">{t("pages.open")}</span>
        </>
      }
      title={t("pages.openHint")}
      name={t("pages.open")}
      class="button"
      popupClass="menu"
    >
      {(close) => (
        <nav aria-label={t("pages.open")}>
          <ul>
            <li>
              <PlaceLink to={PAGES.actuators} isHere={isOfActuators.value} onGo={close}>
                <Entry name="actuators" />
              </PlaceLink>
            </li>
            <li>
              <button
                type="button"
                disabled={session.value === null}
                onClick={() => {
                  close();
                  isTuning.value = true;
                }}
              >
                <Entry name="tune" />
              </button>
            </li>
            <li>
              <a href="docs/guide/" target="_blank" rel="noopener" onClick={close}>
                <Entry name="guide" />
              </a>
            </li>
            <li>
              <a href="docs" target="_blank" rel="noopener" onClick={close}>
                <Entry name="docs" />
              </a>
            </li>
            <li>
              <ul aria-label={t("pages.language")}>
                {(Object.keys(LANGUAGES) as Language[]).map((code) => (
                  <li key={code}>
                    <button
                      type="button"
                      lang={code}
                      aria-current={code === language || undefined}
                      onClick={() => setLanguage(code)}
                    >
                      {LANGUAGES[code]}
                    </button>
                  </li>
                ))}
              </ul>
            </li>
          </ul>
        </nav>
      )}
    </Popup>
  );
}
