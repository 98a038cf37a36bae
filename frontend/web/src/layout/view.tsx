import { useCallback, useEffect, useRef } from "preact/hooks";
import { sessionName } from "../core/api/request";
import { theme } from "../core/state/preferences";
import { connectionCount, session } from "../core/state/session";
import { t } from "../core/text/t";
import { answerKey } from "../lab/keys/keys";
import { addressOf } from "../lab/scene/cameras";
import { SceneLabels } from "../lab/scene/labels";
import { hasWebGl, Schematic } from "../lab/scene/schematic";
import { SceneTools } from "../lab/scene/tools";
import { beginView, enterView, fitCamera, isLow } from "../lab/scene/viewer";
import { CornerMark } from "./marks";

/** viser's page in the frame, with its first camera fitted to the frame. */
function load(frame: HTMLIFrameElement): void {
  const first = addressOf(beginView(frame.clientWidth / frame.clientHeight));
  frame.src = `viser/${sessionName}/?${first}${theme.peek() === "dark" ? "&darkMode" : ""}`;
}

/**
 * The actuator in 3D, served by viser and loaded again after each lost connection; without WebGL in
 * 2D.
 */
export function View({ isBasic }: { isBasic: boolean }) {
  const connection = connectionCount.value;
  const frame = useRef<HTMLIFrameElement | null>(null);
  const begin = useCallback((element: HTMLIFrameElement | null) => {
    frame.current = element;
    if (element !== null) load(element);
  }, []);
  const present = useCallback(() => frame.current, []);
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const resizing = new ResizeObserver(fitCamera);
    if (box.current !== null) resizing.observe(box.current);
    return () => resizing.disconnect();
  }, []);
  return (
    <div class={`surface view ${isLow.value ? "is-low" : ""}`} ref={box}>
      {!hasWebGl && session.value !== null && <Schematic state={session.value} />}
      {hasWebGl && connection > 0 && (
        <iframe
          key={`${connection} ${theme.value}`}
          title={t("view")}
          ref={begin}
          onLoad={({ currentTarget }) => {
            const inner = currentTarget.contentWindow;
            inner?.addEventListener("keydown", answerKey, true);
            const mark = ({ type }: Event) =>
              currentTarget.classList.toggle("is-focused", type === "focus");
            inner?.addEventListener("focus", mark);
            inner?.addEventListener("blur", mark);
            enterView(currentTarget);
          }}
        />
      )}
      {hasWebGl && <SceneLabels frame={present} />}
      {hasWebGl && <SceneTools isBasic={isBasic} />}
      <CornerMark />
    </div>
  );
}
