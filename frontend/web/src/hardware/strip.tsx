import { useId, useState } from "preact/hooks";
import type { BenchState } from "../core/api/types";
import { plantKind } from "../core/state/plant";
import { isLive } from "../core/state/session";
import { t } from "../core/text/t";
import { Problem } from "../core/widgets/form";
import { BenchButtons } from "./buttons";
import { BenchDetails } from "./details";
import { HeatWarning } from "./heat";
import { isSwitchHeld } from "./hold";
import { HoldRow } from "./holdrow";
import { adviceFor, isStarting, needsDetails, STAGES, stagePosition } from "./status";

const STAGE_SIGNS = { done: "✓", here: "●", ahead: "○" } as const;
const STAGE_LOOKS = {
  done: "tone is-accent",
  here: "tone is-accent strong",
  ahead: "muted",
} as const;

/** OFF → RUN as one line; the state is shown by icon and text, not by color alone. */
function Progress({ status }: { status: BenchState["status"] | null }) {
  return (
    <ol class="line joined tiny stages" aria-label={t("bench.stages")}>
      {STAGES.map((stage) => {
        const place = stagePosition(stage, status);
        return (
          <li
            key={stage}
            class={STAGE_LOOKS[place]}
            aria-current={place === "here" ? "step" : undefined}
          >
            <span class="block" aria-hidden="true">
              {STAGE_SIGNS[place]}
            </span>
            {t(`bench.stage.${stage}`)}
            {place === "done" && <span class="visually-hidden"> {t("bench.done")}</span>}
          </li>
        );
      })}
    </ol>
  );
}

/** The strip below the header of a bench: kind, state, and possible next commands. */
export function BenchStrip({ bench }: { bench: BenchState }) {
  const id = useId();
  const isNeeded = needsDetails(bench);
  const [chosen, choose] = useState<{ isNeeded: boolean; isOpen: boolean } | null>(null);
  const isOpen = chosen?.isNeeded === isNeeded ? chosen.isOpen : isNeeded;
  const kind = plantKind.value ?? "real";
  const status = isStarting(bench) ? t("bench.starting") : t(`bench.status.${bench.status}`);
  const advice = t(`bench.advice.${adviceFor(bench, isSwitchHeld.value)}`);
  return (
    <section class={`bench is-${kind}`} aria-label={t("bench.heading")}>
      <div class="row bench-strip">
        <p class={`corner-mark is-${kind} bench-mark`} title={`${bench.name}, ${bench.interface}`}>
          <strong>{t(`mark.${kind}.name`)}</strong>
          <small>{t(`mark.${kind}.means`)}</small>
        </p>
        <Progress status={isLive.value && !isStarting(bench) ? bench.status : null} />
        <p class="small bench-advice" role="status">
          <strong class="block">{isLive.value ? status : t("bench.unknown")}</strong>
          <span>{isLive.value ? advice : t("bench.lastHeard", { state: status })}</span>
          {isLive.value && bench.loop.step !== null && (
            <span aria-live="off">
              {" "}
              {t("bench.startingBy", {
                step: bench.loop.step,
                seconds: Math.floor(bench.loop.starting_s ?? 0),
              })}
            </span>
          )}
          {bench.operator_required && !isStarting(bench) && <span> {t("bench.watch")}</span>}
        </p>
        <BenchButtons bench={bench} />
        <button
          type="button"
          class="button details-button"
          aria-expanded={isOpen}
          aria-controls={id}
          onClick={() => choose({ isNeeded, isOpen: !isOpen })}
        >
          {t("bench.details")}
          <span aria-hidden="true">{isOpen ? "▴" : "▾"}</span>
        </button>
      </div>
      {bench.dead_man && <HoldRow bench={bench} />}
      <HeatWarning bench={bench} />
      <Problem control="bench" />
      <div id={id} hidden={!isOpen}>
        {isOpen && <BenchDetails bench={bench} />}
      </div>
    </section>
  );
}
