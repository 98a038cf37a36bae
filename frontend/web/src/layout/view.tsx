import { answerKey } from "../keys/keys";
import { theme } from "../state/preferences";
import { connectionCount } from "../state/session";
import { text } from "../text/en";
import { CornerMark } from "./marks";

/** The actuator in 3D, served by viser; made anew after each lost connection. */
export function View() {
  const connection = connectionCount.value;
  return (
    <div class="view">
      {connection > 0 && (
        <iframe
          key={connection}
          title={text.view}
          src={theme.value === "dark" ? "viser/?darkMode" : "viser/"}
          onLoad={({ currentTarget: { contentWindow } }) =>
            contentWindow?.addEventListener("keydown", answerKey, true)
          }
        />
      )}
      <CornerMark />
    </div>
  );
}
