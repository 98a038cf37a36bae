import { useId } from "preact/hooks";
import { putLaw } from "../api/client";
import type { SessionState } from "../api/types";
import { perform } from "../state/actions";
import { lawsBeside } from "../state/lanes";
import { brokenLaws, lawOf, usableLaws } from "../state/laws";
import { text } from "../text/en";
import { Choice } from "../widgets/choice";
import { Problem } from "../widgets/problem";
import { Compare } from "./compare";
import { Gains } from "./gains";
import { Group } from "./group";
import { LawForm } from "./law";

export function Controller({ state }: { state: SessionState }) {
  const { law, gains } = state.configuration;
  const present = lawOf(law);
  const options = usableLaws.value.map(({ name, title }) => ({ value: name, label: title }));
  const id = useId();
  return (
    <Group
      title={text.controller.title}
      topic="controller"
      aside={
        <Choice
          label={text.controller.law}
          options={options}
          value={law}
          describedBy={id}
          onChoose={(next) =>
            perform("controller.law", () => putLaw(next, lawsBeside(next, state)))
          }
        />
      }
    >
      <p class="hint is-about" id={id}>
        {present?.summary}
      </p>
      <Problem control="controller.law" />
      <Compare state={state} />
      {present && !present.takes_gains && <LawForm law={present} state={state} />}
      {(!present || present.takes_gains) && <Gains gains={gains} />}
      {brokenLaws.value.map(({ name, problem }) => (
        <p class="problem" key={name}>
          {problem}
        </p>
      ))}
    </Group>
  );
}
