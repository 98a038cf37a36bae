/** Opens a private session of an arm, with an actuator in each joint. */
import { useEffect, useState } from "preact/hooks";
import { type ArmRow, openArm, readArms } from "../../core/api/arm";
import { explain } from "../../core/state/actions";
import { actuators } from "../../core/state/actuators";
import { t } from "../../core/text/t";
import { Choice, SelectField } from "../../core/widgets/form";
import { CardHead, useOpening } from "./opening";

/** The joints' actuators: of the arm, until the user chooses others. */
type Chosen = readonly [string, string];

interface ArmCardProps {
  onProblem: (problem: string) => void;
}

/** The address of the arm among the actuators. */
export const ARM = "arm";

export function ArmCard({ onProblem }: ArmCardProps) {
  const [arms, setArms] = useState<readonly ArmRow[]>([]);
  const [name, setName] = useState<string | null>(null);
  const [chosen, setChosen] = useState<Chosen | null>(null);
  useEffect(() => {
    readArms().then(setArms, (error: unknown) => onProblem(explain(error)));
  }, []);
  const arm = arms.find((candidate) => candidate.name === name) ?? arms[0];
  const [isOpening, open] = useOpening(
    () => openArm(arm?.name ?? "", chosen ?? undefined),
    onProblem,
  );
  if (arm === undefined) return null;
  const [first, second] = chosen ?? [arm.actuator, arm.actuator];
  const names = (actuators.value ?? []).map((actuator) => actuator.name);
  const titleOf = (of: string) =>
    actuators.value?.find((actuator) => actuator.name === of)?.title ?? of;
  return (
    <section class="surface stack card" aria-label={t("arm.name")}>
      <CardHead
        title={t("arm.name")}
        hint={t("arm.lead")}
        openHint={t("arm.openHint")}
        label={isOpening ? t("arm.opening") : t("arm.open")}
        isOpening={isOpening}
        onOpen={open}
      />
      <Choice
        label={t("arm.choose")}
        options={arms.map(({ name: value, title }) => ({ value, label: title }))}
        value={arm.name}
        onChoose={(next) => {
          setName(next);
          setChosen(null);
        }}
      />
      <p translate>{arm.description}</p>
      <div class="form halves">
        <SelectField
          label={t("arm.actuatorOf", { joint: 1 })}
          value={first}
          options={names}
          name={titleOf}
          onChoose={(next) => setChosen([next, second])}
        />
        <SelectField
          label={t("arm.actuatorOf", { joint: 2 })}
          value={second}
          options={names}
          name={titleOf}
          onChoose={(next) => setChosen([first, next])}
        />
      </div>
    </section>
  );
}
