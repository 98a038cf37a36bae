/** EMULATED or REAL BENCH, in words, wherever a student may look. */
import { effect } from "@preact/signals";
import emulatedIcon from "../icons/emulated.svg";
import realIcon from "../icons/real.svg";
import { mark } from "../state/bench";
import { text } from "../text/en";

const ICONS = { emulated: emulatedIcon, real: realIcon } as const;

/** In a corner of something; nothing for a simulation. */
export function CornerMark() {
  const kind = mark.value;
  if (kind === null) return null;
  return <strong class={`corner-mark is-${kind}`}>{text.mark[kind].name}</strong>;
}

/** Keeps the title and the icon of the browser's tab. */
export function markTab(): void {
  const icon = document.querySelector<HTMLLinkElement>('link[rel="icon"]');
  const plainIcon = icon?.getAttribute("href") ?? "";
  effect(() => {
    const kind = mark.value;
    document.title = kind === null ? text.name : `${text.mark[kind].name} · ${text.name}`;
    icon?.setAttribute("href", kind === null ? plainIcon : ICONS[kind]);
  });
}
