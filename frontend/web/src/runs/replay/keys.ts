/** Keys, wherever the focus is but in a control that needs them itself. */
import { isPlaying, seek, stepFrames, timeS, togglePlay } from "./clock";

const KEEPS_ALL = "select, dialog, input:not([type=range])";
/** A button that was reached by key; one that was clicked gives the space bar back. */
const KEEPS_SPACE = "button:focus-visible";

/** Answers a key; also given to the document inside the 3D view. */
export function answerKey(event: KeyboardEvent): void {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const target = event.target as Element | null;
  if (target?.closest?.(KEEPS_ALL)) return;
  if (event.key === " " && target?.matches?.(KEEPS_SPACE)) return;
  const action = actions[event.key];
  if (action === undefined) return;
  event.preventDefault();
  event.stopPropagation();
  action(event.shiftKey);
}

const actions: Record<string, (isShifted: boolean) => void> = {
  " ": togglePlay,
  ArrowLeft: (isShifted) => go(-1, isShifted),
  ArrowRight: (isShifted) => go(1, isShifted),
  Home: () => seek(0),
  End: () => seek(Number.MAX_VALUE),
};

function go(direction: number, isShifted: boolean): void {
  if (isShifted) {
    isPlaying.value = false;
    seek(timeS.peek() + direction);
  } else stepFrames(direction);
}
