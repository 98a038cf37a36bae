import { BenchStrip } from "../bench/strip";
import { Controls } from "../controls/controls";
import { LoadButton } from "../controls/loadbutton";
import { HelpSheet } from "../keys/help";
import { Plots } from "../plots/plots";
import { phase, session } from "../state/session";
import { text } from "../text/en";
import { Banners } from "./banners";
import { Comparison } from "./comparison";
import { Login } from "./login";
import { Readout } from "./readout";
import { StatusBar } from "./statusbar";
import { TopBar } from "./topbar";
import { View } from "./view";

export function App() {
  const state = session.value;
  return (
    <>
      <TopBar />
      {state?.bench && <BenchStrip bench={state.bench} />}
      <Banners />
      <HelpSheet />
      {phase.value === "locked" && <Login />}
      {state === null ? (
        <p class="waiting-page">{text.connection.waiting}</p>
      ) : (
        <main class="lab">
          <View />
          {state.lanes.length > 1 ? <Comparison lanes={state.lanes} /> : <Readout state={state} />}
          <LoadButton state={state} />
          <Plots />
          <Controls state={state} />
        </main>
      )}
      <StatusBar />
    </>
  );
}
