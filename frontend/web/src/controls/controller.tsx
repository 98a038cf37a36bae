import { useId } from "preact/hooks";
import { putController } from "../api/client";
import type { SessionState } from "../api/types";
import { perform } from "../state/actions";
import { text } from "../text/en";
import { Choice } from "./choice";
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
      aside={
        <Choice
          label={text.controller.law}
          options={LAWS}
          value={law}
          describedBy={id}
          onChoose={(next) => void perform("controller.law", () => putController(next))}
        />
      }
    >
      <p class="hint" id={id}>
        {law === "fl" ? text.controller.flDoes : text.controller.ndobcDoes}
      </p>
      <Problem control="controller.law" />
      <Gains gains={gains} />
    </Group>
  );
}
