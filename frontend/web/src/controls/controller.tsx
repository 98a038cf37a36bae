import { useId } from "preact/hooks";
import { putLaw } from "../api/client";
import type { SessionState } from "../api/types";
import { perform } from "../state/actions";
import { lawsBeside } from "../state/lanes";
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
          onChoose={(next) =>
            perform("controller.law", () => putLaw(next, lawsBeside(next, state)))
          }
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
