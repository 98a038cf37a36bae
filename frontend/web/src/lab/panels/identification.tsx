import { signal } from "@preact/signals";
import { useId } from "preact/hooks";
import { putNominal, startExcitation, stopExcitation } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { takesCommands } from "../../core/state/control";
import { session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { formatSeconds } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { Panel } from "../../core/widgets/panel";

export const isIdentifying = signal(false);

function close(): void {
  isIdentifying.value = false;
}

/** Play the excitation for `svsa identify`, and use the result as the model. */
export function IdentificationPanel() {
  const state = session.value;
  if (!isIdentifying.value || state === null) return null;
  return (
    <Panel title={t("identification.title")} class="identification" onClose={close}>
      <fieldset
        class="stack"
        disabled={!takesCommands.value}
        aria-label={t("identification.title")}
      >
        <Identification state={state} />
      </fieldset>
    </Panel>
  );
}

function Identification({ state }: { state: SessionState }) {
  const { excitation } = state;
  return (
    <>
      <p class="hint">
        {t("identification.explanation")} <code>{t("identification.command")}</code>
      </p>
      {excitation === null ? (
        <button
          type="button"
          class="button"
          onClick={() =>
            void perform("identification.excite", startExcitation(t("identification.runName")))
          }
        >
          {t("identification.excite")}
        </button>
      ) : (
        <div class="identification-run">
          <progress
            max={excitation.duration_s}
            value={excitation.elapsed_s}
            aria-label={t("identification.title")}
          />
          <span>
            {t("identification.exciting", {
              elapsed: formatSeconds(excitation.elapsed_s),
              all: formatSeconds(excitation.duration_s),
            })}
          </span>
          <button
            type="button"
            class="button"
            onClick={() => void perform("identification.excite", stopExcitation)}
          >
            {t("identification.stop")}
          </button>
        </div>
      )}
      <Problem control="identification.excite" />
      {state.bench === null ? <ModelFile /> : <p class="hint">{t("identification.bench")}</p>}
    </>
  );
}

function ModelFile() {
  const id = useId();
  const load = async (input: HTMLInputElement) => {
    const file = input.files?.[0];
    if (file === undefined) return;
    const toml = await file.text();
    input.value = "";
    await perform("identification.file", putNominal(toml));
  };
  return (
    <>
      <label class="button">
        {t("identification.file")}
        <input
          type="file"
          accept=".toml"
          class="visually-hidden"
          aria-describedby={id}
          onChange={(event) => void load(event.currentTarget)}
        />
      </label>
      <p class="hint" id={id}>
        {t("identification.fileHint")}
      </p>
      <Problem control="identification.file" />
    </>
  );
}
