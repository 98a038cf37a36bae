import { putLaw } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { comparisonLaws } from "../../core/state/lanes";
import { lawOf, titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { PanelButton } from "../../core/widgets/panel";
import { Problem } from "../../core/widgets/problem";
import { isOpen as isTuning } from "../tuning/tuning";
import { Compare } from "./compare";
import { Gains } from "./gains";
import { Group } from "./group";
import { LawForm } from "./law";
import { LawPicker } from "./lawpicker";

export function Controller({ state }: { state: SessionState }) {
  const { law, gains } = state.configuration;
  const present = lawOf(law);
  return (
    <Group
      title={text.controller.title}
      topic="controller"
      aside={
        <LawPicker
          label={`${text.controller.law}: ${titleOf(law)}`}
          button={titleOf(law)}
          title={text.laws.choose}
          value={law}
          onChoose={(next) =>
            perform("controller.law", () => putLaw(next, comparisonLaws(next, state)))
          }
        />
      }
    >
      <p class="hint is-about">{present?.summary}</p>
      <Problem control="controller.law" />
      {present && !present.takes_gains && <LawForm law={present} state={state} />}
      {(!present || present.takes_gains) && <Gains gains={gains} />}
      <div class="tune-open">
        <PanelButton isOpen={isTuning} hint={text.tuning.openHint}>
          {text.tuning.open}
        </PanelButton>
      </div>
      <Compare state={state} />
    </Group>
  );
}
