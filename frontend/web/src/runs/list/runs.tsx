import { useEffect } from "preact/hooks";
import { t } from "../../core/text/t";
import { ErrorLine } from "../../core/widgets/form";
import { deleted, restoreFromTrash } from "./list";
import { ListPage } from "./listpage";
import { OverlayPage } from "./overlaypage";
import type { RunsPlace } from "./place";
import { runsProblem } from "./problem";
import { RunPage } from "./runpage";

function Inside({ at }: { at: RunsPlace }) {
  if (at.kind === "list") return <ListPage />;
  if (at.kind === "overlay") return <OverlayPage runs={at.runs} />;
  return <RunPage key={at.run} run={at.run} timeS={at.timeS} />;
}

/** The last deletion, until the user dismisses it. */
function Undo() {
  const run = deleted.value;
  return (
    <div class="line loose floating toast" role="status" hidden={run === null}>
      {run && (
        <>
          <span>{t("runs.deleted", { name: run.title })}</span>
          <button type="button" class="button" onClick={() => void restoreFromTrash(run.id)}>
            {t("runs.undo")}
          </button>
          <button
            type="button"
            class="quiet"
            aria-label={t("runs.dismiss")}
            onClick={() => {
              deleted.value = null;
            }}
          >
            ✕
          </button>
        </>
      )}
    </div>
  );
}

/** The recorded runs, instead of the lab. */
export function Runs({ at }: { at: RunsPlace }) {
  useEffect(() => {
    runsProblem.value = "";
  }, [at.kind]);
  return (
    <main
      class={at.kind === "run" ? "page column grow is-run" : "page column scroller"}
      aria-label={t("runs.title")}
    >
      <ErrorLine>{runsProblem.value}</ErrorLine>
      <Inside at={at} />
      <Undo />
    </main>
  );
}
