import { useId, useState } from "preact/hooks";
import type { RunSummary } from "../../core/api/types";
import { t } from "../../core/text/t";
import { patchRun } from "./list";

interface TagsProps {
  run: RunSummary;
  onChanged?: (run: RunSummary) => void;
  onRefused?: () => void;
}

/** The tags of a run, with a field for a new one. */
export function Tags({ run, onChanged, onRefused }: TagsProps) {
  const id = useId();
  const [draft, setDraft] = useState<string | null>(null);
  const put = async (tags: string[]) => {
    const answer = await patchRun(run, { tags });
    if (answer) onChanged?.(answer);
    else onRefused?.();
  };
  const add = (event: Event) => {
    event.preventDefault();
    const tag = (draft ?? "").trim();
    setDraft(null);
    if (tag !== "" && !run.tags.includes(tag)) void put([...run.tags, tag]);
  };
  return (
    <ul class="row" aria-label={t("runs.tagsOf", { name: run.title })}>
      {run.tags.map((tag) => (
        <li key={tag} class="line tight tag">
          {tag}
          <button
            type="button"
            class="quiet muted"
            aria-label={t("runs.removeTag", { tag })}
            title={t("runs.removeTag", { tag })}
            onClick={() => void put(run.tags.filter((other) => other !== tag))}
          >
            ✕
          </button>
        </li>
      ))}
      <li>
        {draft === null ? (
          <button type="button" class="quiet" onClick={() => setDraft("")}>
            {t("runs.addTag")}
          </button>
        ) : (
          <form class="line" onSubmit={add}>
            <label class="visually-hidden" for={id}>
              {t("runs.newTag")}
            </label>
            <input
              id={id}
              type="text"
              maxLength={50}
              ref={(element) => element?.focus()}
              value={draft}
              placeholder={t("runs.newTag")}
              onInput={(event) => setDraft(event.currentTarget.value)}
              onKeyDown={(event) => {
                if (event.key === "Escape") setDraft(null);
              }}
              onBlur={(event) => {
                if (event.currentTarget.value.trim() === "") setDraft(null);
              }}
            />
            <button type="submit" class="quiet">
              {t("runs.add")}
            </button>
          </form>
        )}
      </li>
    </ul>
  );
}
