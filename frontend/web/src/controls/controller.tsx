import { useId } from "preact/hooks";
import { putLanes, putLaw } from "../api/client";
import type { Law, SessionState } from "../api/types";
import { perform } from "../state/actions";
import { otherLaw, rivalsOf } from "../state/lanes";
import { text } from "../text/en";
import { Choice } from "./choice";
import { Compare } from "./compare";
import { Gains } from "./gains";
import { Group } from "./group";
import { Problem } from "./problem";

const LAWS = [
  { value: "fl", label: text.controller.fl },
  { value: "ndobc", label: text.controller.ndobc },
] as const;

/** Takes a law; one that ran beside as a rival changes places with it. */
async function chooseLaw(law: Law, state: SessionState): Promise<SessionState> {
  const rivals = rivalsOf(state);
  const answer = await putLaw(law);
  const isDouble = rivals.length === 1 && rivals[0]?.law === law && state.recording === null;
  return isDouble ? putLanes([otherLaw(law)]) : answer;
}

export function Controller({ state }: { state: SessionState }) {
  const { law, gains } = state.configuration;
  const id = useId();
  return (
    <Group
      title={text.controller.title}
      topic="controller"
      aside={
        <Choice
          label={text.controller.law}
          options={LAWS}
          value={law}
          describedBy={id}
          onChoose={(next) => perform("controller.law", () => chooseLaw(next, state))}
        />
      }
    >
      <p class="hint is-about" id={id}>
        {law === "fl" ? text.controller.flDoes : text.controller.ndobcDoes}
      </p>
      <Problem control="controller.law" />
      <Compare state={state} />
      <Gains gains={gains} />
    </Group>
  );
}
