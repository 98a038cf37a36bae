import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import type { Follows } from "../../core/api/design";
import type { PositionReference, SessionState, StiffnessReference } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { text } from "../../core/text/en";
import { Choice, type Option, Problem } from "../../core/widgets/form";
import { Group } from "./group";
import { Shaped, titleOf } from "./shaped";

type Kind = "sine" | "constant" | "other";

/** A sine and a constant have fields; every other reference has a beginning and an end. */
const kindOf = ({ kind }: PositionReference | StiffnessReference): Kind =>
  kind === "sine" || kind === "constant" ? kind : "other";

const nameOf = (kinds: readonly Option<Kind>[], kind: Kind): string =>
  kinds.find(({ value }) => value === kind)?.label ?? "";

interface ReferenceGroupProps {
  /** The name of its controls, the title and the equation. */
  topic: "motion" | "stiffness";
  follows: Follows;
  reference: PositionReference | StiffnessReference;
  kinds: readonly Option<Kind>[];
  /** Sends the reference of this kind. */
  onChoose: (kind: Exclude<Kind, "other">) => Promise<SessionState>;
  /** The fields of a sine or a constant. */
  children: ComponentChildren;
}

/** What the session follows: its kind, its fields, or how to shape one with an end. */
export function ReferenceGroup(props: ReferenceGroupProps) {
  const { topic, follows, reference, kinds, onChoose, children } = props;
  const { title, kind } = text[topic];
  const [isOther, setOther] = useState(false);
  const shown = isOther ? "other" : kindOf(reference);
  const choose = (next: Kind) => {
    setOther(next === "other");
    return next === "other" ? undefined : perform(`${topic}.kind`, () => onChoose(next));
  };
  return (
    <Group
      title={title}
      topic={topic}
      aside={<Choice label={kind} options={kinds} value={shown} onChoose={choose} />}
    >
      <Problem control={`${topic}.kind`} />
      {shown !== kindOf(reference) && (
        <p class="hint">{text.references.notApplied(nameOf(kinds, kindOf(reference)))}</p>
      )}
      {shown === "other" ? <Shaped follows={follows} held={reference.kind} /> : children}
      {kindOf(reference) === "other" && (
        <p class="hint">
          {text.references.following(titleOf(follows, reference.kind), reference.transition_s)}
        </p>
      )}
    </Group>
  );
}
