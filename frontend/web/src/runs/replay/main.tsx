/**
 * The page of an exported run; `window.svsaReplay` lets the console, a test or the surrounding page
 * control it.
 */
import "uplot/dist/uPlot.min.css";
import "../../theme.css";
import "../../base.css";
import "../../parts.css";
import "../../primitives.css";
import "../../core/widgets/plantmark.css";
import "../../lab/scene/labels.css";
import "../../core/plots/plots.css";
import "./replay.css";
import "./about.css";
import "./view.css";
import "./numbers.css";
import "./plots.css";
import "./playback.css";
import { render } from "preact";
import "../../core/translation";
import { useMemo } from "preact/hooks";
import { type Theme, theme } from "../../core/state/preferences";
import { t } from "../../core/text/t";
import { Header } from "./about";
import { handleKey, seek, setUpClock, timeS } from "./clock";
import { definePlots, makeTimeAxis } from "./curves";
import { type Recording, readRecording } from "./data";
import { Numbers } from "./numbers";
import { Plot } from "./plot";
import { Transport } from "./transport";
import { View } from "./view";

declare global {
  interface Window {
    svsaReplay: { time(): number; seek(timeS: number): void; setTheme(chosen: Theme): void };
  }
}

/** The moment in the address, `?t=12.3`; 0 by default. */
function readMoment(): number {
  const timeS = Number(new URLSearchParams(location.search).get("t"));
  return Number.isFinite(timeS) ? timeS : 0;
}

const host = document.getElementById("replay") as HTMLElement;
try {
  const recording = await readRecording();
  const { motion, curves } = recording.run;
  setUpClock({
    endS: recording.endS,
    frameS: motion.step_s,
    pointS: curves.step_s,
    isEverySample: curves.stride === 1,
  });
  seek(readMoment());
  document.documentElement.classList.toggle("is-embedded", window.parent !== window);
  render(<App recording={recording} />, host);
  window.addEventListener("keydown", handleKey);
  const setTheme = (chosen: Theme) => {
    theme.value = chosen;
  };
  window.svsaReplay = { time: () => timeS.peek(), seek, setTheme };
} catch (error) {
  console.error(error);
  host.textContent = t("replay.broken");
}

function App({ recording }: { recording: Recording }) {
  const plots = useMemo(() => definePlots(recording), [recording]);
  const time = useMemo(() => makeTimeAxis(recording), [recording]);
  return (
    <>
      <Header run={recording.run} />
      <main>
        <View recording={recording} />
        <Numbers recording={recording} />
        <section
          class={`surface plots ${recording.run.arm === null ? "" : "is-arm"}`}
          aria-label={t("plots.heading")}
        >
          {plots.map((plot, index) => (
            <Plot
              key={plot.key}
              plot={plot}
              time={time}
              events={recording.run.events}
              isFirst={index === 0}
              isLast={index === plots.length - 1}
              isBench={recording.run.plant !== "simulated"}
            />
          ))}
        </section>
      </main>
      <Transport recording={recording} />
    </>
  );
}
