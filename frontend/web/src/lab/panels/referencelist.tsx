/** References as an edited or opened list: steps line by line, a time series as CSV. */
import { t } from "../../core/text/t";
import { MAX_LEVELS } from "./shapes";

interface ListProps {
  label: string;
  rows: number;
  list: string;
  onList: (list: string) => void;
}

function List({ label, rows, list, onList }: ListProps) {
  return (
    <textarea
      class="block listed"
      rows={rows}
      spellcheck={false}
      aria-label={label}
      value={list}
      onInput={(event) => onList(event.currentTarget.value)}
    />
  );
}

export function Levels({ unit, ...list }: Pick<ListProps, "list" | "onList"> & { unit: string }) {
  return (
    <>
      <List label={t("references.levels", { unit })} rows={6} {...list} />
      <p class="hint">
        {t("references.levelsHint", { unit, most: MAX_LEVELS, half: MAX_LEVELS / 2 })}
      </p>
    </>
  );
}

export function Series({ list, onList }: Pick<ListProps, "list" | "onList">) {
  const open = async (event: Event) => {
    const file = (event.currentTarget as HTMLInputElement).files?.[0];
    if (file) onList(await file.text());
  };
  return (
    <>
      <label class="button">
        {t("references.openCsv")}
        <input
          type="file"
          class="visually-hidden"
          accept=".csv,text/csv"
          onChange={(event) => void open(event)}
        />
      </label>
      <List label={t("references.pasteCsv")} rows={4} list={list} onList={onList} />
      <p class="hint">{t("references.csvHint")}</p>
    </>
  );
}
