/** Where a student may look, what the session moves: EMULATED, REAL BENCH, or that it is not known yet. */
import { effect } from "@preact/signals";
import emulatedIcon from "../core/icons/emulated.svg";
import realIcon from "../core/icons/real.svg";
import { mark } from "../core/state/session";
import { text } from "../core/text/en";
import { PlantMark } from "../core/widgets/plantmark";

const ICONS = { emulated: emulatedIcon, real: realIcon, unknown: realIcon } as const;

/** That of the session, in a corner of something. */
export function CornerMark() {
  return <PlantMark kind={mark.value} />;
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
