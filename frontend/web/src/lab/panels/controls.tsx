import { useRef } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { takesCommands } from "../../core/state/control";
import { text } from "../../core/text/en";
import { Controller } from "./controller";
import { GroupIndex } from "./group";
import { hasOtherLoads, Loads } from "./load";
import { Motion } from "./motion";
import { Observer } from "./observer";
import { Realism } from "./realism";
import { Stiffness } from "./stiffness";

interface ControlsProps {
  state: SessionState;
  isBasic?: boolean;
}

/**
 * Everything a student sets, in the order of the block diagram.
 *
 * isBasic: the controller alone, with loads and effects that act in addition to the button's.
 */
export function Controls({ state, isBasic = false }: ControlsProps) {
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
        {!isBasic && (
          <>
            <Motion state={state} />
            <Stiffness state={state} />
          </>
        )}
        <Controller state={state} isBasic={isBasic} />
        {!isBasic && <Observer state={state} />}
        {(!isBasic || hasOtherLoads(state)) && <Loads state={state} />}
        {state.bench === null && (!isBasic || state.configuration.effects_preset !== "ideal") && (
          <Realism state={state} />
        )}
      </div>
      <GroupIndex groups={groups} />
    </fieldset>
  );
}
