import type { SessionState } from "../core/api/types";
import { Plots } from "../core/plots/plots";
import { loginCount } from "../core/state/access";
import { isArm } from "../core/state/arm";
import { phase, session } from "../core/state/session";
import { languageOf, t } from "../core/text/t";
import { BenchStrip } from "../hardware/strip";
import { TipPlane } from "../lab/arm/plane";
import { DesignPanel } from "../lab/design/panel";
import { HelpSheet } from "../lab/keys/help";
import { Controls } from "../lab/panels/controls";
import { IdentificationPanel } from "../lab/panels/identification";
import { LoadButton } from "../lab/panels/loadbutton";
import { hasWebGl } from "../lab/scene/schematic";
import { CallsDrawer } from "../lab/script/drawer";
import { isOpen as isTuning } from "../lab/tuning/tuning";
import { PrivateBanner } from "../runs/list/origin";
import { isLabShown, isRunsPlace, type Place, place } from "../runs/list/place";
import { Runs } from "../runs/list/runs";
import { ClassPanel } from "../teaching/classroom/panel";
import { hasFreeSettings } from "../teaching/course/lesson";
import { LearnPage } from "../teaching/course/page";
import { Tour } from "../teaching/course/tour";
import { Lesson } from "../teaching/course/view";
import { Banners } from "./banners";
import { isBasic } from "./basic";
import { Comparison } from "./comparison";
import { LazyPage } from "./lazypage";
import { Login } from "./login";
import { EvaluationTabs } from "./pages";
import { Readout } from "./readout";
import { SavedNote } from "./savednote";
import { StatusBar } from "./statusbar";
import { TopBar } from "./topbar";
import { View } from "./view";

/** The 3D view; of an arm also its plane, alone without WebGL. */
function Views({ state, isBasic }: { state: SessionState; isBasic: boolean }) {
  if (!isArm.value) return <View isBasic={isBasic} />;
  return (
    <div class="arm-views">
      {hasWebGl && <View isBasic={isBasic} />}
      <TipPlane state={state} {...(hasWebGl ? {} : { note: t("arm.noWebGl") })} />
    </div>
  );
}

/** The texts of the page of an address. */
function areaOf(at: Place): Parameters<typeof languageOf>[0] {
  if (isRunsPlace(at)) return "runs";
  if (at.kind === "learn") return at.exercise === "" ? "learning" : "session";
  return at.kind === "lab" ? "session" : at.kind;
}

/** The page of the current address. */
function Here() {
  const state = session.value;
  const at = place.value;
  return isRunsPlace(at) ? (
    <Runs at={at} />
  ) : at.kind === "actuators" ||
    at.kind === "ranking" ||
    at.kind === "leaderboard" ||
    at.kind === "grades" ||
    at.kind === "studies" ||
    at.kind === "falsifier" ? (
    <LazyPage name={at.kind} />
  ) : at.kind === "learn" && at.exercise === "" ? (
    <LearnPage />
  ) : state === null ? (
    <main class="empty">{phase.value !== "ended" && t("connection.waiting")}</main>
  ) : (
    <main class={at.kind === "learn" ? "lab has-lesson" : isBasic.value ? "lab is-basic" : "lab"}>
      <Views state={state} isBasic={isBasic.value} />
      {state.lanes.length > 1 ? <Comparison state={state} /> : <Readout state={state} />}
      <LoadButton state={state} />
      <Plots isBasic={isBasic.value} />
      {at.kind === "learn" ? (
        <div class="column scroller lesson-side" lang={languageOf("lesson")}>
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
      {isLabShown(at) && state !== null && (
        <>
          <a class="skip" href="#plots">
            {t("skip")}
          </a>
          {(at.kind !== "learn" || hasFreeSettings.value) && (
            <a class="skip" href="#controls">
              {t("skipToControls")}
            </a>
          )}
        </>
      )}
      <TopBar />
      <EvaluationTabs />
      {(isLabShown(at) || at.kind === "list") && state?.bench && <BenchStrip bench={state.bench} />}
      <PrivateBanner />
      <Banners />
      <HelpSheet />
      {phase.value === "locked" && <Login />}
      <div class="contents" lang={languageOf(areaOf(at))}>
        <Here key={loginCount.value} />
      </div>
      <DesignPanel />
      {isTuning.value && state !== null && <LazyPage name="tuning" isPanel />}
      <IdentificationPanel />
      <ClassPanel />
      {state !== null && at.kind === "lab" && <Tour />}
      <CallsDrawer />
      <SavedNote />
      <StatusBar />
    </>
  );
}
