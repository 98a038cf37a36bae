import { useState } from "preact/hooks";
import type { SessionRequest } from "../../core/api/client";
import type { Follows } from "../../core/api/design";
import type { PositionReference, StiffnessReference } from "../../core/api/types";
import { LiveFields } from "../../core/forms/fields";
import type { SliderRange } from "../../core/scale";
import { changeAt, type Schema } from "../../core/schema";
import { perform } from "../../core/state/actions";
import { areJointsDifferent, settings } from "../../core/state/arm";
import { currentValueOr } from "../../core/state/conflicts";
import { t } from "../../core/text/t";
import { Choice, type Option, Problem } from "../../core/widgets/form";
import { Group } from "./group";
import { putReference, Shaped, titleOf } from "./shaped";

export const FREQUENCIES: SliderRange = { min: 0.02, max: 2, logarithmic: true };

type Kind = "sine" | "constant" | "other";

/** A sine and a constant have fields; every other reference has a start and an end. */
const kindOf = ({ kind }: PositionReference | StiffnessReference): Kind =>
  kind === "sine" || kind === "constant" ? kind : "other";

const nameOf = (kinds: readonly Option<Kind>[], kind: Kind): string =>
  kinds.find(({ value }) => value === kind)?.label ?? "";

interface ReferenceGroupProps {
  /** Name of its controls, of its title and of its equation. */
  topic: "motion" | "stiffness";
  follows: Follows;
  reference: PositionReference | StiffnessReference;
  kinds: readonly Option<Kind>[];
  /** Send the reference of this kind. */
  onChoose: (kind: Exclude<Kind, "other">) => SessionRequest;
  /** The fields of a sine or a constant. */
  schemas: Readonly<Record<Exclude<Kind, "other">, Schema>>;
}

/** The reference of the session: its kind, its fields, or the form of a finite one. */
export function ReferenceGroup(props: ReferenceGroupProps) {
  const { topic, follows, reference, kinds, onChoose, schemas } = props;
  const configuration = settings.value?.configuration;
  const [isOther, setOther] = useState(false);
  const shown = isOther ? "other" : kindOf(reference);
  const choose = (next: Kind) => {
    setOther(next === "other");
    return next === "other" ? undefined : perform(`${topic}.kind`, onChoose(next));
  };
  return (
    <Group
      title={t(`${topic}.title`)}
      topic={topic}
      aside={<Choice label={t(`${topic}.kind`)} options={kinds} value={shown} onChoose={choose} />}
    >
      <Problem control={`${topic}.kind`} />
      {settings.value && areJointsDifferent(settings.value, [follows]) && (
        <p class="hint">{t("arm.differ")}</p>
      )}
      {shown !== kindOf(reference) && (
        <p class="hint">{t("references.notApplied", { kind: nameOf(kinds, kindOf(reference)) })}</p>
      )}
      {shown === "other" && configuration !== undefined ? (
        <Shaped follows={follows} held={reference.kind} configuration={configuration} />
      ) : (
        (reference.kind === "sine" || reference.kind === "constant") && (
          <LiveFields
            name={topic}
            schema={schemas[reference.kind]}
            value={reference}
            send={(path, value) =>
              putReference(follows, changeAt(currentValueOr(follows, reference), path, value))
            }
          />
        )
      )}
      {kindOf(reference) === "other" && (
        <p class="hint">
          {t("references.following", {
            kind: titleOf(follows, reference.kind),
            fadeS: reference.transition_s,
          })}
        </p>
      )}
    </Group>
  );
}
