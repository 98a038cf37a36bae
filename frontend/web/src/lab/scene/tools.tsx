import { isArm } from "../../core/state/arm";
import { session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { cameraNames } from "./cameras";
import { isPushing, PushLayer } from "./push";
import { areNamesOn, isLow, sceneKind, setCamera, toggleLow, toggleNames } from "./viewer";

/** The tip of an arm is pushed in the picture of its plane. */
function PushButton() {
  if (session.value?.bench !== null || isArm.value) return null;
  return (
    <button
      type="button"
      class="button is-small tool"
      aria-pressed={isPushing.value}
      title={t("scene.pushHint")}
      onClick={() => {
        isPushing.value = !isPushing.peek();
      }}
    >
      <svg viewBox="0 0 12 12" aria-hidden="true">
        <path d="M3.4 6.2V2.3a.8.8 0 0 1 1.6 0v2.6-3.6a.8.8 0 0 1 1.6 0v3.6-2.8a.8.8 0 0 1 1.6 0v3-1.6a.8.8 0 0 1 1.6 0v4.2c0 2.4-1.4 3.8-3.5 3.8-1.7 0-2.6-.8-3.4-2.3L1.4 7.1c-.5-1 .8-1.7 1.4-.9z" />
      </svg>
      {t("scene.push")}
    </button>
  );
}

/** The scene of an arm has no names of parts. */
function NamesButton() {
  if (isArm.value) return null;
  return (
    <button
      type="button"
      class="button is-small tool is-icon"
      aria-pressed={areNamesOn.value}
      aria-label={t("scene.names")}
      aria-keyshortcuts="N"
      title={`${t("scene.names")} (N): ${t("scene.namesHint")}`}
      onClick={toggleNames}
    >
      <svg viewBox="0 0 12 12" aria-hidden="true">
        <path d="M1 1h6.5v3.5H1zM2.2 10.2l3-4.6.9.6-3 4.6z" />
        <circle cx="2.4" cy="10.3" r="1.4" />
      </svg>
    </button>
  );
}

/** Cameras, pushing and graphics quality, below the 3D view. */
export function SceneTools({ isBasic }: { isBasic: boolean }) {
  if (isBasic) return null;
  return (
    <>
      {isPushing.value && <PushLayer />}
      <div
        class="line tight scene-tools"
        data-over-picture
        role="toolbar"
        aria-label={t("scene.tools")}
      >
        {cameraNames(sceneKind()).map((name) => (
          <button
            key={name}
            type="button"
            class="button is-small tool"
            aria-label={t("scene.cameraHint", { name: t(`scene.cameras.${name}`) })}
            onClick={() => setCamera(name)}
          >
            {t(`scene.cameras.${name}`)}
          </button>
        ))}
        <span class="line tight end">
          <PushButton />
          <NamesButton />
          <button
            type="button"
            class="button is-small tool is-icon"
            aria-pressed={isLow.value}
            aria-label={t("scene.low")}
            title={`${t("scene.low")}: ${t("scene.lowHint")}`}
            onClick={toggleLow}
          >
            <svg viewBox="0 0 12 12" aria-hidden="true">
              <path d="M1 8h2v3H1zM4 6h2v5H4z" />
              <path d="M7.5 4.5v6h1v-6zM10.2 2v8.5h1V2z" opacity="0.45" />
            </svg>
          </button>
        </span>
      </div>
    </>
  );
}
