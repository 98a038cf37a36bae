import { useId } from "preact/hooks";
import { confirmHome } from "../core/api/client";
import type { Axis, BenchState } from "../core/api/types";
import { perform } from "../core/state/actions";
import { mayCommand } from "../core/state/control";
import { personName, setPersonName } from "../core/state/preferences";
import { t } from "../core/text/t";
import { Problem } from "../core/widgets/form";
import { allowedCommands } from "./status";

const AXES: readonly Axis[] = ["link", "motor1", "motor2"];

function Axes({ bench: { homing } }: { bench: BenchState }) {
  return (
    <ol class="row">
      {AXES.map((axis) => {
        const isDone = homing.done.includes(axis);
        const isNext = homing.next_step === axis;
        return (
          <li
            key={axis}
            class={isDone ? "good" : isNext ? "strong" : ""}
            aria-current={isNext ? "step" : undefined}
          >
            <span aria-hidden="true">{isDone ? "✓" : isNext ? "▸" : "○"}</span>{" "}
            {t(`bench.homing.axis.${axis}`)}
            {isDone && <span class="visually-hidden"> {t("bench.done")}</span>}
            {isNext && <small> {t("bench.homing.here")}</small>}
          </li>
        );
      })}
    </ol>
  );
}

function Confirmation({ axis, isAllowed }: { axis: Axis; isAllowed: boolean }) {
  const id = useId();
  const submit = (event: Event) => {
    event.preventDefault();
    void perform("bench.home", confirmHome(axis, personName.peek().trim()));
  };
  return (
    <form class="pair homing-form" onSubmit={submit}>
      <label for={id}>{t("bench.homing.by")}</label>
      <input
        id={id}
        type="text"
        required
        maxLength={100}
        autocomplete="name"
        value={personName.value}
        onInput={(event) => setPersonName(event.currentTarget.value)}
      />
      <button
        type="submit"
        class={`button wide ${isAllowed ? "is-primary" : ""}`}
        disabled={!isAllowed || personName.value.trim() === ""}
      >
        {t(`bench.homing.confirm.${axis}`)}
      </button>
      {!isAllowed && <p class="hint wide">{t("bench.homing.notNow")}</p>}
    </form>
  );
}

/** Guided homing: the operator checks each mark and confirms it by name. */
export function Homing({ bench }: { bench: BenchState }) {
  const { next_step: next, instruction } = bench.homing;
  return (
    <section class="surface small bench-card" aria-label={t("bench.homing.heading")}>
      <h2>{t("bench.homing.heading")}</h2>
      <Axes bench={bench} />
      <p class="instruction" role="status">
        {next === null ? t("bench.homing.allDone") : instruction}
      </p>
      {next !== null && (
        <Confirmation axis={next} isAllowed={allowedCommands(bench).home && mayCommand.value} />
      )}
      <Problem control="bench.home" />
    </section>
  );
}
