import { Plots } from "../core/plots/plots";
import { comings } from "../core/state/control";
import { phase, session } from "../core/state/session";
import { text } from "../core/text/en";
import { BenchStrip } from "../hardware/strip";
import { DesignPanel } from "../lab/design/panel";
import { HelpSheet } from "../lab/keys/help";
import { Controls } from "../lab/panels/controls";
import { IdentificationPanel } from "../lab/panels/identification";
import { LoadButton } from "../lab/panels/loadbutton";
import { CallsDrawer } from "../lab/script/drawer";
import { TunePanel } from "../lab/tuning/panel";
import { PrivateBanner } from "../runs/list/origin";
import { isOfLab, isOfRuns, place } from "../runs/list/place";
import { Runs } from "../runs/list/runs";
import { ClassPanel } from "../teaching/classroom/panel";
import { hasFreeSettings } from "../teaching/course/lesson";
import { LearnPage } from "../teaching/course/page";
import { Tour } from "../teaching/course/tour";
import { Lesson } from "../teaching/course/view";
import { Banners } from "./banners";
import { isBasic } from "./basic";
import { Comparison } from "./comparison";
import { FetchedPage } from "./fetched";
import { Login } from "./login";
import { EvaluationTabs } from "./pages";
import { Readout } from "./readout";
import { SavedNote } from "./savednote";
import { StatusBar } from "./statusbar";
import { TopBar } from "./topbar";
import { View } from "./view";

/** The page that the address names. */
function Here() {
  const state = session.value;
  const at = place.value;
  return isOfRuns(at) ? (
    <Runs at={at} />
  ) : at.kind === "actuators" ||
    at.kind === "ranking" ||
    at.kind === "leaderboard" ||
    at.kind === "grades" ||
    at.kind === "studies" ||
    at.kind === "falsifier" ? (
    <FetchedPage name={at.kind} />
  ) : at.kind === "learn" && at.exercise === "" ? (
    <LearnPage />
  ) : state === null ? (
    <main class="waiting-page">{phase.value !== "ended" && text.connection.waiting}</main>
  ) : (
    <main class={at.kind === "learn" ? "lab has-lesson" : isBasic.value ? "lab is-basic" : "lab"}>
      <View isBasic={isBasic.value} />
      {state.lanes.length > 1 ? <Comparison state={state} /> : <Readout state={state} />}
      <LoadButton state={state} />
      <Plots isBasic={isBasic.value} />
      {at.kind === "learn" ? (
        <div class="lesson-side">
          <Lesson name={at.exercise} />
          {hasFreeSettings.value && <Controls state={state} />}
        </div>
      ) : (
        <Controls state={state} isBasic={isBasic.value} />
      )}
    </main>
  );
}

/** A login reloads the page: earlier requests were rejected, or made as another user. */
export function App() {
  const state = session.value;
  const at = place.value;
  return (
    <>
      {isOfLab(at) && state !== null && (
        <>
          <a class="skip" href="#plots">
            {text.skip}
          </a>
          {(at.kind !== "learn" || hasFreeSettings.value) && (
            <a class="skip" href="#controls">
              {text.skipToControls}
            </a>
          )}
        </>
      )}
      <TopBar />
      <EvaluationTabs />
      {(isOfLab(at) || at.kind === "list") && state?.bench && <BenchStrip bench={state.bench} />}
      <PrivateBanner />
      <Banners />
      <HelpSheet />
      {phase.value === "locked" && <Login />}
      <Here key={comings.value} />
      <DesignPanel />
      <TunePanel />
      <IdentificationPanel />
      <ClassPanel />
      {state !== null && at.kind === "lab" && <Tour />}
      <CallsDrawer />
      <SavedNote />
      <StatusBar />
    </>
  );
}
