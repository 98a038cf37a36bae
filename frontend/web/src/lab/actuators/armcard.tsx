/** Opens a private session of an arm, with an actuator in each joint. */
import { useEffect, useState } from "preact/hooks";
import { type ArmRow, openArm, readArms } from "../../core/api/arm";
import { explain } from "../../core/state/actions";
import { actuators } from "../../core/state/actuators";
import { listJoints } from "../../core/state/joints";
import { t } from "../../core/text/t";
import { Choice, SelectField } from "../../core/widgets/form";
import { CardHead, useOpening } from "./opening";

/** The joints' actuators: of the arm, until the user chooses others. */
type Chosen = readonly string[];

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
  const own = chosen ?? arm.links.chain.map(() => arm.actuator);
  const most = arm.links.chain.length;
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
        {most > 1 && (
          <SelectField
            label={t("arm.jointCount")}
            value={String(own.length)}
            options={listJoints(most).map(String)}
            name={(count) => count}
            onChoose={(next) =>
              setChosen(listJoints(Number(next)).map((joint) => own[joint - 1] ?? arm.actuator))
            }
          />
        )}
        {own.map((actuator, index) => (
          <SelectField
            key={index}
            label={t("arm.actuatorOf", { joint: index + 1 })}
            value={actuator}
            options={names}
            name={titleOf}
            onChoose={(next) => setChosen(own.map((name, at) => (at === index ? next : name)))}
          />
        ))}
      </div>
    </section>
  );
}
