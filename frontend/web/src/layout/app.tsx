import { ArenaPage } from "../arena/page";
import { BenchStrip } from "../bench/strip";
import { ClassPanel } from "../classroom/panel";
import { Controls } from "../controls/controls";
import { LoadButton } from "../controls/loadbutton";
import { DesignPanel } from "../design/panel";
import { FalsifierPage } from "../falsifier/page";
import { GradesPage } from "../grades/page";
import { HelpSheet } from "../keys/help";
import { LeaderboardPage } from "../leaderboard/page";
import { hasFreeSettings } from "../learning/lesson";
import { LearnPage } from "../learning/page";
import { Tour } from "../learning/tour";
import { Lesson } from "../learning/view";
import { Plots } from "../plots/plots";
import { isOfLab, isOfRuns, place } from "../runs/place";
import { PrivateBanner } from "../runs/private";
import { Runs } from "../runs/runs";
import { CallsDrawer } from "../script/drawer";
import { comings } from "../state/access";
import { phase, session } from "../state/session";
import { StudiesPage } from "../studies/page";
import { text } from "../text/en";
import { TunePanel } from "../tuning/panel";
import { Banners } from "./banners";
import { Comparison } from "./comparison";
import { Login } from "./login";
import { Readout } from "./readout";
import { StatusBar } from "./statusbar";
import { TopBar } from "./topbar";
import { View } from "./view";

/** The page that the address names. */
function Here() {
  const state = session.value;
  const at = place.value;
  return isOfRuns(at) ? (
    <Runs at={at} />
  ) : at.kind === "arena" ? (
    <ArenaPage />
  ) : at.kind === "leaderboard" ? (
    <LeaderboardPage />
  ) : at.kind === "grades" ? (
    <GradesPage />
  ) : at.kind === "studies" ? (
    <StudiesPage />
  ) : at.kind === "learn" && at.exercise === "" ? (
    <LearnPage />
  ) : at.kind === "falsifier" ? (
    <FalsifierPage />
  ) : state === null ? (
    <main class="waiting-page">{phase.value !== "ended" && text.connection.waiting}</main>
  ) : (
    <main class={at.kind === "learn" ? "lab has-lesson" : "lab"}>
      <View />
      {state.lanes.length > 1 ? <Comparison state={state} /> : <Readout state={state} />}
      <LoadButton state={state} />
      <Plots />
      {at.kind === "learn" ? (
        <div class="lesson-side">
          <Lesson name={at.exercise} />
          {hasFreeSettings.value && <Controls state={state} />}
        </div>
      ) : (
        <Controls state={state} />
      )}
    </main>
  );
}

/** Whoever comes in begins the page anew: what it asked before was refused, or another's. */
export function App() {
  const state = session.value;
  const at = place.value;
  return (
    <>
      {isOfLab(at) && state !== null && (
        <a class="skip" href="#plots">
          {text.skip}
        </a>
      )}
      <TopBar />
      {(isOfLab(at) || at.kind === "list") && state?.bench && <BenchStrip bench={state.bench} />}
      <PrivateBanner />
      <Banners />
      <HelpSheet />
      {phase.value === "locked" && <Login />}
      <Here key={comings.value} />
      <DesignPanel />
      <TunePanel />
      <ClassPanel />
      {state !== null && at.kind === "lab" && <Tour />}
      <CallsDrawer />
      <StatusBar />
    </>
  );
}
