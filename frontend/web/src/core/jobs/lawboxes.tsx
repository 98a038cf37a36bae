import type { Law } from "../api/types";
import { usableLaws } from "../state/laws";
import { Boxes } from "./boxes";

interface LawBoxesProps {
  laws: readonly Law[];
  onChange: (laws: readonly Law[]) => void;
}

/** Any of the laws that are installed, each a box. */
export function LawBoxes({ laws, onChange }: LawBoxesProps) {
  return <Boxes offered={usableLaws.value} chosen={laws} onChange={onChange} />;
}
