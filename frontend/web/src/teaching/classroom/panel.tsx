import { signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import {
  broadcast,
  type ClassCode,
  type ClassState,
  createToken,
  endSession,
  leave,
  readClass,
  removePerson,
  renewCode,
  renewRejoinCode,
  restorePerson,
} from "../../core/api/access";
import { access, isClass, isInstructor, updateAccess } from "../../core/state/access";
import { explain } from "../../core/state/actions";
import { phase } from "../../core/state/session";
import { t } from "../../core/text/t";
import { ErrorLine } from "../../core/widgets/form";
import { Panel, PanelButton } from "../../core/widgets/panel";
import { PlaceLink } from "../../runs/list/place";
import { AuditLog } from "./auditlog";
import { rejoinCode } from "./join";
import { Members } from "./members";
import { People, Removed, Sessions, Waiting } from "./people";

function close(): void {
  isOpen.value = false;
}

/** Members, queue and sessions of a class; for the instructor also the commands. */
function Inside() {
  const classState = useSignal<ClassState | null>(null);
  const code = useSignal<ClassCode | null>(null);
  const token = useSignal("");
  const note = useSignal("");
  const isAudited = useSignal(false);
  const attempt = async (act: () => Promise<unknown>) => {
    note.value = "";
    try {
      await act();
      classState.value = await readClass();
    } catch (error) {
      note.value = explain(error);
    }
  };
  useEffect(() => {
    void attempt(async () => {});
    const timer = setInterval(() => {
      readClass().then(
        (state) => {
          classState.value = state;
        },
        () => {},
      );
    }, READ_MS);
    return () => clearInterval(timer);
  }, []);
  return (
    <div class="stack loose">
      <ErrorLine>{note.value}</ErrorLine>
      {isInstructor.value && (
        <div class="row">
          <button
            type="button"
            class="button"
            title={t("classroom.broadcastHint")}
            onClick={() =>
              void attempt(async () => {
                const sent = await broadcast();
                note.value =
                  sent.refused.length === 0
                    ? t("classroom.sent", { accepted: sent.taken })
                    : t("classroom.sentPartly", {
                        accepted: sent.taken,
                        refused: sent.refused.length,
                      });
              })
            }
          >
            {t("classroom.broadcast")}
          </button>
          <button
            type="button"
            class="button"
            title={t("classroom.newCodeHint")}
            onClick={() =>
              void attempt(async () => {
                code.value = await renewCode();
              })
            }
          >
            {t("classroom.newCode")}
          </button>
          <PlaceLink to={{ kind: "list" }} class="button">
            {t("classroom.runs")}
          </PlaceLink>
          <PlaceLink to={{ kind: "grades" }} class="button">
            {t("grades.title")}
          </PlaceLink>
        </div>
      )}
      {code.value && <Code code={code.value} />}
      <Waiting />
      {classState.value && (
        <>
          <People
            people={classState.value.people}
            remove={(id) => void attempt(() => removePerson(id))}
          />
          <Removed
            removed={classState.value.removed}
            restore={(id) => void attempt(() => restorePerson(id))}
          />
        </>
      )}
      {classState.value && (
        <Sessions
          sessions={classState.value.sessions}
          end={(name) => void attempt(() => endSession(name))}
        />
      )}
      {isInstructor.value && <Members attempt={(act) => void attempt(act)} />}
      {isInstructor.value && (
        <AuditLog
          isOpen={isAudited.value}
          onToggle={() => {
            isAudited.value = !isAudited.peek();
          }}
        />
      )}
      <div class="row">
        <button
          type="button"
          class="button"
          title={t("classroom.scriptHint")}
          onClick={() =>
            void attempt(async () => {
              token.value = (await createToken()).token;
            })
          }
        >
          {t("classroom.script")}
        </button>
        {!isInstructor.value && (
          <button
            type="button"
            class="button"
            title={t("classroom.newRejoinCodeHint")}
            onClick={() =>
              void attempt(async () => {
                rejoinCode.value = (await renewRejoinCode()).rejoin_code;
              })
            }
          >
            {t("classroom.newRejoinCode")}
          </button>
        )}
        <button
          type="button"
          class="button"
          title={isInstructor.value ? undefined : t("classroom.leaveHint")}
          onClick={() =>
            void attempt(async () => {
              await leave();
              await updateAccess();
              close();
              phase.value = "locked";
            })
          }
        >
          {t("classroom.leave")}
        </button>
      </div>
      {token.value !== "" && (
        <div>
          {t("classroom.scriptOnce")} <pre>{token.value}</pre>
        </div>
      )}
    </div>
  );
}

export function ClassPanel() {
  if (!isOpen.value || !isClass.value || access.value?.inside !== true) return null;
  return (
    <Panel title={t("classroom.panelTitle")} class="class-panel" onClose={close}>
      <Inside />
    </Panel>
  );
}

export function ClassButton() {
  if (!isClass.value) return null;
  return (
    <PanelButton isOpen={isOpen} hint={t("classroom.openHint")} name={t("classroom.open")}>
      <svg viewBox="0 0 16 16" aria-hidden="true">
        <path d="M5.5 7.5a2.75 2.75 0 1 0 0-5.5 2.75 2.75 0 0 0 0 5.5zM0 14c0-3 2.2-5 5.5-5S11 11 11 14zM11 7.5a2.25 2.25 0 1 0-.9-4.3 4 4 0 0 1 0 3.9q.4.4.9.4zM12.3 14H16c0-2.6-1.8-4.5-4.6-4.5l-.6.1c1 1 1.5 2.5 1.5 4.4z" />
      </svg>
    </PanelButton>
  );
}

// Whether the panel of the class is open, and how often it is reloaded then.

const isOpen = signal(false);
const READ_MS = 2000;

/** A new class code, large, as text and QR code for projection. */
function Code({ code }: { code: ClassCode }) {
  return (
    <figure class="stack">
      <figcaption>
        {t("classroom.codeOnce")} <strong class="class-code">{code.code}</strong>
      </figcaption>
      <img src={code.qr} width="240" alt={t("classroom.qr", { code: code.code })} />
      <span class="block breaks">{code.address}</span>
      {code.is_local && <strong>{t("classroom.onlyHere")}</strong>}
    </figure>
  );
}
