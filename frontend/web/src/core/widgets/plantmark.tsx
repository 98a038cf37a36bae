/** The label EMULATED or REAL BENCH next to data of a bench. */
import type { PlantKind } from "../state/plant";
import { t } from "../text/t";

export function PlantMark({ kind }: { kind: PlantKind | null }) {
  if (kind === null) return null;
  return (
    <strong class={`corner-mark is-${kind}`} data-over-picture>
      {t(`mark.${kind}.name`)}
    </strong>
  );
}
