import { useSignalEffect } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { atMoment } from "../../core/api/runs";
import { theme } from "../../core/state/preferences";
import { t } from "../../core/text/t";
import { pressStop } from "../../lab/safety/stop";

interface ReplayFrameProps {
  /** Address of its page. */
  source: string;
  name: string;
  /** Initial position of the replay, s after the record's first sample. */
  startS: number;
  onMoment: (timeS: number) => void;
}

const ASK_MS = 200;

/** The replay has its own keys; only the quick stop is forwarded. */
function passStop(event: KeyboardEvent): void {
  if (event.key !== "Escape" || !event.shiftKey) return;
  event.preventDefault();
  event.stopPropagation();
  void pressStop();
}

/** Message of the server instead of a replay, for example if too many wait; null for a replay. */
function readRefusal(shown: Document | null): string | null {
  if (shown === null) return t("connection.unreachable");
  if (shown.contentType === "text/html") return null;
  try {
    return String(JSON.parse(shown.body.innerText).detail);
  } catch {
    return t("connection.unreachable");
  }
}

/** The replay page of a run, in the current theme. */
export function ReplayFrame({ source, name, startS, onMoment }: ReplayFrameProps) {
  const frame = useRef<HTMLIFrameElement>(null);
  const moment = useRef(startS);
  const [tries, setTries] = useState(0);
  const address = `${source} ${tries}`;
  const [came, setCame] = useState<{ address: string; refusal: string | null } | null>(null);
  const replayOf = () => (frame.current?.contentWindow as Partial<Window> | null)?.svsaReplay;
  const answer = came?.address === address ? came : null;
  useEffect(() => {
    const timer = setInterval(() => {
      const replay = replayOf();
      if (replay === undefined) return;
      replay.setTheme(theme.peek());
      moment.current = replay.time();
      onMoment(moment.current);
    }, ASK_MS);
    return () => clearInterval(timer);
  }, [onMoment]);
  useSignalEffect(() => replayOf()?.setTheme(theme.value));
  return (
    <div class="replay-place">
      {answer === null && (
        <p class="muted over" role="status">
          {t("run.waiting")}
        </p>
      )}
      {answer?.refusal && (
        <div class="muted over" role="alert">
          <p class="problem">{answer.refusal}</p>
          <button type="button" class="button" onClick={() => setTries(tries + 1)}>
            {t("run.again")}
          </button>
        </div>
      )}
      <iframe
        key={address}
        ref={frame}
        hidden={Boolean(answer?.refusal)}
        title={t("run.replay", { name })}
        src={atMoment(source, moment.current)}
        onLoad={({ currentTarget: { contentDocument, contentWindow } }) => {
          const refusal = readRefusal(contentDocument);
          if (refusal === null) contentWindow?.addEventListener("keydown", passStop, true);
          setCame({ address, refusal });
        }}
      />
    </div>
  );
}
