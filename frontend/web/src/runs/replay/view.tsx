import { effect } from "@preact/signals";
import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { lineStyleOf } from "../../core/plots/linestyles";
import { LANES_OF_ARM, nameArms } from "../../core/state/joints";
import { theme } from "../../core/state/preferences";
import { t } from "../../core/text/t";
import { PlantMark } from "../../core/widgets/plantmark";
import { SceneLabels } from "../../lab/scene/labels";
import { handleKey, timeS } from "./clock";
import { findMark, type Recording, type Run } from "./data";
import { Scene } from "./scene";

const FASTEST_MS = 1000 / 30;
/** The view is reported as missing after this time, and still shown if it starts later. */
const PATIENCE_MS = 30_000;

/** Shows the clock's time in 3D, at most 30 times per second. */
function followClock(scene: Scene): () => void {
  let shownAt = 0;
  let pending = 0;
  const show = () => {
    pending = 0;
    shownAt = performance.now();
    scene.show(timeS.peek());
  };
  const stop = effect(() => {
    void timeS.value;
    const wait = FASTEST_MS - 2 - (performance.now() - shownAt);
    if (wait <= 0) show();
    else if (pending === 0) pending = window.setTimeout(show, wait);
  });
  return () => {
    window.clearTimeout(pending);
    stop();
  };
}

/** The outlines of a lane have the colors of its curves. */
const coloursOf = ({ segments }: Run, lane: number) => [
  ...new Set(segments[lane]?.map(({ line_style: lineStyle }) => lineStyleOf(lineStyle).colour)),
];

export function View({ recording: { run, arrays } }: { recording: Recording }) {
  const frame = useRef<HTMLIFrameElement>(null);
  const [state, setState] = useState<"starting" | "shown" | "failed">("starting");
  const present = useCallback(() => frame.current, []);
  const [own, plants] = run.arm === null ? [1, run.lanes] : [LANES_OF_ARM, nameArms(run.lanes)];
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
    <section class={`surface view is-${state}`} aria-label={t("replay.view")}>
      <iframe ref={frame} title={t("replay.view")} />
      {state === "shown" && <SceneLabels frame={present} />}
      <PlantMark kind={findMark(run)} />
      {state === "failed" && <p class="muted view-problem">{t("replay.noView")}</p>}
      <ul class="row small view-legend">
        {plants.map((name, index) => (
          <li key={`${index}.${name}`}>
            {index === 0 ? (
              <i class="is-actuator" />
            ) : (
              coloursOf(run, own * index).map((colour) => <i key={colour} class={`is-${colour}`} />)
            )}
            <span class="legend-name">{name}</span>
            <small>{index === 0 ? t("replay.drawn.lane") : t("replay.drawn.ghost")}</small>
          </li>
        ))}
        <li>
          <i class="is-reference" />
          {t("replay.drawn.reference")}
        </li>
        {run.arm !== null && (
          <li>
            <i class="is-ellipse" />
            {t("replay.drawn.ellipse")}
          </li>
        )}
      </ul>
    </section>
  );
}
