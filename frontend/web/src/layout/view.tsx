import { sessionName } from "../api/request";
import { answerKey } from "../keys/keys";
import { SceneTools } from "../scene/tools";
import { enterView, isLow } from "../scene/viewer";
import { theme } from "../state/preferences";
import { connectionCount } from "../state/session";
import { text } from "../text/en";
import { CornerMark } from "./marks";

/** The actuator in 3D, served by viser; made anew after each lost connection. */
export function View() {
  const connection = connectionCount.value;
  return (
    <div class={`view ${isLow.value ? "is-low" : ""}`}>
      {connection > 0 && (
        <iframe
          key={connection}
          title={text.view}
          src={`viser/${sessionName}/${theme.value === "dark" ? "?darkMode" : ""}`}
          onLoad={({ currentTarget }) => {
            currentTarget.contentWindow?.addEventListener("keydown", answerKey, true);
            enterView(currentTarget);
          }}
        />
      )}
      <SceneTools />
      <CornerMark />
    </div>
  );
}
