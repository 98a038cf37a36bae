/** The kind of plant that the session moves: EMULATED, REAL BENCH, or unknown. */
import { effect } from "@preact/signals";
import emulatedIcon from "../core/icons/emulated.svg";
import realIcon from "../core/icons/real.svg";
import { plantKind } from "../core/state/plant";
import { t } from "../core/text/t";
import { PlantMark } from "../core/widgets/plantmark";

const ICONS = { emulated: emulatedIcon, real: realIcon, unknown: realIcon } as const;

/** The mark of the session, in the corner of an element. */
export function CornerMark() {
  return <PlantMark kind={plantKind.value} />;
}

/** Update the title and the icon of the browser's tab. */
export function markTab(): void {
  const icon = document.querySelector<HTMLLinkElement>('link[rel="icon"]');
  const plainIcon = icon?.getAttribute("href") ?? "";
  effect(() => {
    const kind = plantKind.value;
    document.title = kind === null ? t("name") : `${t(`mark.${kind}.name`)} · ${t("name")}`;
    icon?.setAttribute("href", kind === null ? plainIcon : ICONS[kind]);
  });
}
