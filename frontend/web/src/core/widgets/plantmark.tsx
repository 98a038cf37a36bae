/** The label EMULATED or REAL BENCH next to data of a bench. */
import type { PlantKind } from "../state/plant";
import { benchText as text } from "../text/bench";

export function PlantMark({ kind }: { kind: PlantKind | null }) {
  if (kind === null) return null;
  return (
    <strong class={`corner-mark is-${kind}`} data-over-picture>
      {text.mark[kind].name}
    </strong>
  );
}
