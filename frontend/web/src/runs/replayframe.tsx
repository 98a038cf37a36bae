import { useEffect, useRef, useState } from "preact/hooks";
import { replayAddress } from "../api/runs";
import { pressStop } from "../safety/stop";
import { theme } from "../state/preferences";
import { text } from "../text/en";

interface ReplayFrameProps {
  run: string;
  name: string;
  /** Where the replay stands when it opens, s after the record's first sample. */
  startS: number;
  onMoment: (timeS: number) => void;
}

const ASK_MS = 200;

/** The replay has keys of its own; only the quick stop goes through. */
function passStop(event: KeyboardEvent): void {
  if (event.key !== "Escape" || !event.shiftKey) return;
  event.preventDefault();
  event.stopPropagation();
  void pressStop();
}

/** The replay page of a run; made anew where the theme changes, at the moment that was shown. */
export function ReplayFrame({ run, name, startS, onMoment }: ReplayFrameProps) {
  const frame = useRef<HTMLIFrameElement>(null);
  const moment = useRef(startS);
  const address = `${theme.value} ${run}`;
  const [shown, setShown] = useState("");
  useEffect(() => {
    const timer = setInterval(() => {
      const replay = (frame.current?.contentWindow as Partial<Window> | null)?.svsaReplay;
      if (replay === undefined) return;
      moment.current = replay.time();
      onMoment(moment.current);
    }, ASK_MS);
    return () => clearInterval(timer);
  }, [onMoment]);
  return (
    <div class="replay-place">
      {shown !== address && (
        <p class="replay-waiting" role="status">
          {text.run.waiting}
        </p>
      )}
      <iframe
        key={address}
        ref={frame}
        class="replay-frame"
        title={text.run.replay(name)}
        src={replayAddress(run, moment.current)}
        onLoad={({ currentTarget: { contentWindow } }) => {
          contentWindow?.addEventListener("keydown", passStop, true);
          setShown(address);
        }}
      />
    </div>
  );
}
