import { signal } from "@preact/signals";
import { useId } from "preact/hooks";
import { putNominal, startExcitation, stopExcitation } from "../../core/api/client";
import type { SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { takesCommands } from "../../core/state/control";
import { session } from "../../core/state/session";
import { text } from "../../core/text/en";
import { formatSeconds } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { Panel } from "../../core/widgets/panel";

const words = text.identification;

export const isIdentifying = signal(false);

function close(): void {
  isIdentifying.value = false;
}

/** Play the excitation for `svsa identify`, and use the result as the model. */
export function IdentificationPanel() {
  const state = session.value;
  if (!isIdentifying.value || state === null) return null;
  return (
    <Panel title={words.title} class="identification" onClose={close}>
      <fieldset class="stack" disabled={!takesCommands.value} aria-label={words.title}>
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
        {words.explanation} <code>{words.command}</code>
      </p>
      {excitation === null ? (
        <button
          type="button"
          class="button"
          onClick={() => void perform("identification.excite", startExcitation(words.runName))}
        >
          {words.excite}
        </button>
      ) : (
        <div class="identification-run">
          <progress
            max={excitation.duration_s}
            value={excitation.elapsed_s}
            aria-label={words.title}
          />
          <span>
            {words.exciting(
              formatSeconds(excitation.elapsed_s),
              formatSeconds(excitation.duration_s),
            )}
          </span>
          <button
            type="button"
            class="button"
            onClick={() => void perform("identification.excite", stopExcitation)}
          >
            {words.stop}
          </button>
        </div>
      )}
      <Problem control="identification.excite" />
      {state.bench === null ? <ModelFile /> : <p class="hint">{words.bench}</p>}
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
        {words.file}
        <input
          type="file"
          accept=".toml"
          class="visually-hidden"
          aria-describedby={id}
          onChange={(event) => void load(event.currentTarget)}
        />
      </label>
      <p class="hint" id={id}>
        {words.fileHint}
      </p>
      <Problem control="identification.file" />
    </>
  );
}
