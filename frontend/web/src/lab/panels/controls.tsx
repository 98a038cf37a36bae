import { useRef } from "preact/hooks";
import type { SessionState } from "../../core/api/types";
import { settingsOf } from "../../core/state/arm";
import { takesCommands } from "../../core/state/control";
import { armOf } from "../../core/state/joints";
import { t } from "../../core/text/t";
import { ArmGroup } from "./armgroup";
import { Controller } from "./controller";
import { GroupIndex } from "./group";
import { hasOtherLoads, Loads } from "./load";
import { Motion } from "./motion";
import { Observer } from "./observer";
import { Realism } from "./realism";
import { Spring } from "./spring";
import { Stiffness } from "./stiffness";

interface ControlsProps {
  state: SessionState;
  isBasic?: boolean;
}

/**
 * All settings, in the order of the block diagram.
 *
 * isBasic: only the controller, and active loads and effects that have no button.
 */
export function Controls({ state: session, isBasic = false }: ControlsProps) {
  const state = settingsOf(session);
  const groups = useRef<HTMLDivElement>(null);
  return (
    <section
      id="controls"
      tabIndex={-1}
      class="surface column joined controls"
      aria-label={t("controls.heading")}
    >
      {/* Without control nothing in it takes the focus, and the keyboard has to scroll it. */}
      <div class="scroller groups" ref={groups} tabIndex={takesCommands.value ? undefined : 0}>
        <fieldset class="contents" disabled={!takesCommands.value}>
          <ArmGroup state={session} isBasic={isBasic} />
          {!isBasic && (
            <>
              {!armOf(session)?.tip && <Motion state={state} />}
              <Stiffness state={state} />
            </>
          )}
          <Controller state={state} isBasic={isBasic} />
          {!isBasic && (
            <>
              <Observer state={state} />
              <Spring state={state} />
            </>
          )}
          {(!isBasic || hasOtherLoads(state)) && <Loads state={state} />}
          {state.bench === null && (!isBasic || state.configuration.effects_preset !== "ideal") && (
            <Realism state={state} />
          )}
        </fieldset>
      </div>
      <GroupIndex groups={groups} />
    </section>
  );
}
