import { useRef } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { takesCommands } from "../../core/state/control";
import { text } from "../../core/text/en";
import { Controller } from "./controller";
import { GroupIndex } from "./group";
import { Identification } from "./identification";
import { Loads } from "./load";
import { Motion } from "./motion";
import { Observer } from "./observer";
import { Realism } from "./realism";
import { Stiffness } from "./stiffness";

/** Everything a student sets, in the order of the block diagram. */
export function Controls({ state }: { state: SessionState }) {
  const groups = useRef<HTMLDivElement>(null);
  return (
    <fieldset
      id="controls"
      tabIndex={-1}
      class="surface controls"
      disabled={!takesCommands.value}
      aria-label={text.controls.heading}
    >
      <div class="groups" ref={groups}>
        <Motion state={state} />
        <Stiffness state={state} />
        <Controller state={state} />
        <Observer state={state} />
        <Loads state={state} />
        {state.bench === null && <Realism state={state} />}
        <Identification state={state} />
      </div>
      <GroupIndex groups={groups} />
    </fieldset>
  );
}
