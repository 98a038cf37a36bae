import { reset, stopRecording } from "../core/api/client";
import { commandStatus } from "../core/api/outcome";
import { perform } from "../core/state/actions";
import { isLost, isNewInstance, phase, session } from "../core/state/session";
import { t } from "../core/text/t";
import { formatFixed } from "../core/units";
import { Banner } from "../core/widgets/banner";
import { Problem } from "../core/widgets/form";
import { ControlBanner } from "../lab/lease/banner";
import { FaultAdvice, StopBanners } from "../lab/safety/stopbanner";
import { place } from "../runs/list/place";
import { RejoinCodeBanner } from "../teaching/classroom/join";
import { ExerciseBanner } from "../teaching/course/experiment";

/** For a command whose answer was lost: outcome unknown, or executed. */
function CommandStatus({ now }: { now: NonNullable<typeof commandStatus.value> }) {
  const isPending = now === "asking";
  return (
    <Banner
      look={isPending ? "is-bad" : "is-accent"}
      role="alert"
      sign={isPending ? "◌" : "✓"}
      title={isPending ? t("connection.askingTitle") : t("connection.carriedOutTitle")}
      words={isPending ? t("connection.askingText") : t("connection.carriedOutText")}
    />
  );
}

/** The page continues in a new session without the previous state. */
function NewInstance() {
  const close = () => {
    isNewInstance.value = false;
  };
  return (
    <Banner
      look="is-accent"
      title={t("connection.anotherTitle")}
      words={t("connection.anotherText")}
    >
      <button type="button" class="quiet" aria-label={t("runs.dismiss")} onClick={close}>
        ✕
      </button>
    </Banner>
  );
}

/** Important messages: no connection, a fault, a rejected command of the top bar. */
export function Banners() {
  const fault = session.value?.bench ? null : session.value?.fault;
  const recording = session.value?.recording;
  const isBlocked = phase.value === "blocked";
  return (
    <div class="banners">
      <StopBanners />
      {commandStatus.value !== null && <CommandStatus now={commandStatus.value} />}
      {isLost.value && (
        <Banner
          look="is-bad"
          role="alert"
          sign="◌"
          title={isBlocked ? t("connection.blockedTitle") : t("connection.lostTitle")}
          words={isBlocked ? t("connection.blockedText") : t("connection.lostText")}
        />
      )}
      {isNewInstance.value && !isLost.value && <NewInstance />}
      {fault && (
        <div class="row banner is-bad" role="alert">
          <span class="bad" aria-hidden="true">
            ▲
          </span>
          <div class="grow">
            <strong class="bad">{t("fault.title", { time: formatFixed(fault.time_s, 2) })}</strong>{" "}
            {fault.message}
            <FaultAdvice fault={fault} />
          </div>
          <button
            type="button"
            class="button"
            disabled={isLost.value}
            onClick={() => void perform("session", reset)}
          >
            {t("fault.reset")}
          </button>
        </div>
      )}
      {recording?.state === "failed" && (
        <Banner
          look="is-bad"
          role="alert"
          sign="▲"
          title={t("recording.failed")}
          words={recording.message}
        >
          <button
            type="button"
            class="button"
            disabled={isLost.value}
            onClick={() => void perform("session", stopRecording)}
          >
            {t("recording.close")}
          </button>
        </Banner>
      )}
      <ControlBanner />
      <RejoinCodeBanner />
      {session.value?.exercise && place.value.kind === "lab" && (
        <ExerciseBanner exercise={session.value.exercise} />
      )}
      <Problem control="session" />
    </div>
  );
}
