import { ArenaPage } from "../arena/page";
import { BenchStrip } from "../bench/strip";
import { ClassPanel } from "../classroom/panel";
import { Controls } from "../controls/controls";
import { LoadButton } from "../controls/loadbutton";
import { DesignPanel } from "../design/panel";
import { HelpSheet } from "../keys/help";
import { LearnPanel } from "../learning/panel";
import { Tour } from "../learning/tour";
import { Plots } from "../plots/plots";
import { isOfRuns, place } from "../runs/place";
import { PrivateBanner } from "../runs/private";
import { Runs } from "../runs/runs";
import { CallsDrawer } from "../script/drawer";
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

export function App() {
  const state = session.value;
  const at = place.value;
  return (
    <>
      {at.kind === "lab" && state !== null && (
        <a class="skip" href="#plots">
          {text.skip}
        </a>
      )}
      <TopBar />
      {(at.kind === "lab" || at.kind === "list") && state?.bench && (
        <BenchStrip bench={state.bench} />
      )}
      <PrivateBanner />
      <Banners />
      <HelpSheet />
      {phase.value === "locked" && <Login />}
      {isOfRuns(at) ? (
        <Runs at={at} />
      ) : at.kind === "arena" ? (
        <ArenaPage />
      ) : at.kind === "studies" ? (
        <StudiesPage />
      ) : state === null ? (
        phase.value !== "ended" && <main class="waiting-page">{text.connection.waiting}</main>
      ) : (
        <main class="lab">
          <View />
          {state.lanes.length > 1 ? <Comparison state={state} /> : <Readout state={state} />}
          <LoadButton state={state} />
          <Plots />
          <Controls state={state} />
        </main>
      )}
      <DesignPanel />
      <TunePanel />
      <LearnPanel />
      <ClassPanel />
      {state !== null && at.kind === "lab" && <Tour />}
      <CallsDrawer />
      <StatusBar />
    </>
  );
}
