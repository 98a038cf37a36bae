import { t } from "../../core/text/t";
import { COLUMNS, NAME_SORT } from "./columns";
import { changeQuery, FILTERS, type Filter, filters, isTrash, runList, search, sort } from "./list";
import { nameValue } from "./words";

/** A filter by a value of the runs; nothing if there is only one value. */
function FilterChoice({ filter }: { filter: Filter }) {
  const counts = Object.entries(runList.value?.facets[filter] ?? {});
  const value = filters.value[filter];
  if (counts.length < (filter === "tag" ? 1 : 2) && value === "") return null;
  const isAlone = search.value === "" && FILTERS.every((other) => filters.value[other] === "");
  const options = counts.some(([name]) => name === value)
    ? counts
    : [...counts, [value, 0] as const];
  return (
    <label>
      <span class="visually-hidden">{t(`runs.filters.${filter}.name`)}</span>
      <select
        value={value}
        class={value === "" ? "" : "is-chosen"}
        onChange={(event) => changeQuery({ filters: { [filter]: event.currentTarget.value } })}
      >
        <option value="">{t(`runs.filters.${filter}.any`)}</option>
        {options
          .filter(([name]) => name !== "")
          .map(([name, count]) => (
            <option key={name} value={name}>
              {isAlone
                ? t("runs.counted", { name: nameValue(filter, name), count })
                : nameValue(filter, name)}
            </option>
          ))}
      </select>
    </label>
  );
}

/** The sort order, for windows in which the table has no header. */
function SortChoice() {
  const columns = [{ name: t("runs.columns.name"), sort: NAME_SORT }, ...COLUMNS].filter(
    ({ sort: order }) => order !== undefined,
  );
  return (
    <label class="runs-sort">
      <span class="visually-hidden">{t("runs.sort")}</span>
      <select
        value={sort.value}
        onChange={(event) => changeQuery({ sort: event.currentTarget.value })}
      >
        {columns.map((column) => (
          <>
            <option key={column.sort} value={column.sort}>
              {t("runs.sortUp", { column: column.name })}
            </option>
            <option key={`-${column.sort}`} value={`-${column.sort}`}>
              {t("runs.sortDown", { column: column.name })}
            </option>
          </>
        ))}
      </select>
    </label>
  );
}

export function Finder() {
  return (
    <search class="row grow runs-finder">
      <label class="runs-search">
        <span class="visually-hidden">{t("runs.search")}</span>
        <input
          type="search"
          maxLength={200}
          placeholder={t("runs.searchHint")}
          title={t("runs.searchDoes")}
          value={search.value}
          onInput={(event) => changeQuery({ search: event.currentTarget.value })}
        />
      </label>
      {FILTERS.map((filter) => (
        <FilterChoice key={filter} filter={filter} />
      ))}
      <SortChoice />
      <button
        type="button"
        class="button"
        aria-pressed={isTrash.value}
        title={t("runs.trashHint")}
        onClick={() => changeQuery({ isTrash: !isTrash.peek() })}
      >
        {t("runs.trash")}
      </button>
    </search>
  );
}
