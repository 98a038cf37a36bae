import { effect } from "@preact/signals";
import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { lineStyleOf } from "../../core/plots/linestyles";
import { limitRate } from "../../core/rate";
import { nameArms } from "../../core/state/joints";
import { plantKindOfRun } from "../../core/state/plant";
import { theme } from "../../core/state/preferences";
import { t } from "../../core/text/t";
import { PlantMark } from "../../core/widgets/plantmark";
import { SceneLabels } from "../../lab/scene/labels";
import { handleKey, timeS } from "./clock";
import type { Recording, Run } from "./data";
import { Scene } from "./scene";

const FASTEST_MS = 1000 / 30;
/** The view is reported as missing after this time, and still shown if it starts later. */
const PATIENCE_MS = 30_000;

/** Shows the clock's time in 3D, at most 30 times per second. */
function followClock(scene: Scene): () => void {
  const { request, cancel } = limitRate(
    () => scene.show(timeS.peek()),
    () => FASTEST_MS - 2,
  );
  const stop = effect(() => {
    void timeS.value;
    request();
  });
  return () => {
    cancel();
    stop();
  };
}

/** The colors of the scene, the same in light and dark. */
const COLOURS: Readonly<Record<string, string>> = {
  actuator: "rgb(222 226 231)",
  vermilion: "rgb(213 94 0 / 60%)",
  green: "rgb(0 158 115 / 60%)",
  purple: "rgb(184 84 148 / 60%)",
  blue: "rgb(0 114 178 / 60%)",
  orange: "rgb(214 140 10 / 60%)",
  ellipse: "rgb(122 82 186 / 50%)",
  reference: "rgb(24 168 156 / 50%)",
};

const Dot = ({ of }: { of: string }) => <i class="dot" style={{ background: COLOURS[of] }} />;

/** The outlines of a lane have the colors of its curves. */
const coloursOf = ({ segments }: Run, lane: number) => [
  ...new Set(segments[lane]?.map(({ line_style: lineStyle }) => lineStyleOf(lineStyle).colour)),
];

export function View({ recording: { run, arrays } }: { recording: Recording }) {
  const frame = useRef<HTMLIFrameElement>(null);
  const [state, setState] = useState<"starting" | "shown" | "failed">("starting");
  const present = useCallback(() => frame.current, []);
  const own = run.arm?.chain.length ?? 1;
  const plants = run.arm === null ? run.lanes : nameArms(run.lanes, own);
  useEffect(() => {
    const element = frame.current;
    if (element === null) return;
    const scene = new Scene(run.motion, arrays);
    const ends: (() => void)[] = [];
    const start = async () => {
      element.contentWindow?.addEventListener("keydown", handleKey, true);
      const giveUp = window.setTimeout(() => setState("failed"), PATIENCE_MS);
      const isBuilt = await scene.connect(element);
      window.clearTimeout(giveUp);
      if (!isBuilt) return;
      ends.push(effect(() => scene.setTheme(theme.value === "dark")));
      ends.push(followClock(scene));
      setState("shown");
    };
    element.addEventListener("load", () => void start(), { once: true });
    element.srcdoc = run.scene.replace("<html", '<html translate="no"');
    return () => {
      for (const end of ends) end();
    };
  }, [run, arrays]);
  return (
    <section class={`surface column joined view is-${state}`} aria-label={t("replay.view")}>
      <iframe ref={frame} title={t("replay.view")} />
      {state === "shown" && <SceneLabels frame={present} />}
      <PlantMark kind={plantKindOfRun(run.plant)} />
      {state === "failed" && <p class="muted over">{t("replay.noView")}</p>}
      <ul class="row small view-legend">
        {plants.map((name, index) => (
          <li key={`${index}.${name}`} class="line tight">
            {index === 0 ? (
              <Dot of="actuator" />
            ) : (
              coloursOf(run, own * index).map((colour) => <Dot key={colour} of={colour} />)
            )}
            <span class="legend-name">{name}</span>
            <small>{index === 0 ? t("replay.drawn.lane") : t("replay.drawn.ghost")}</small>
          </li>
        ))}
        <li>
          <Dot of="reference" />
          {t("replay.drawn.reference")}
        </li>
        {run.arm !== null && (
          <li>
            <Dot of="ellipse" />
            {t("replay.drawn.ellipse")}
          </li>
        )}
      </ul>
    </section>
  );
}
