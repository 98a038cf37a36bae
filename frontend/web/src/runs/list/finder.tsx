import { text } from "../../core/text/en";
import { COLUMNS, NAME_SORT } from "./columns";
import { changeQuery, FILTERS, type Filter, filters, isTrash, runList, search, sort } from "./list";
import { nameValue } from "./words";

const words = text.runs;

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
      <span class="visually-hidden">{words.filters[filter].name}</span>
      <select
        value={value}
        class={value === "" ? "" : "is-chosen"}
        onChange={(event) => changeQuery({ filters: { [filter]: event.currentTarget.value } })}
      >
        <option value="">{words.filters[filter].any}</option>
        {options
          .filter(([name]) => name !== "")
          .map(([name, count]) => (
            <option key={name} value={name}>
              {isAlone ? words.counted(nameValue(filter, name), count) : nameValue(filter, name)}
            </option>
          ))}
      </select>
    </label>
  );
}

/** The sort order, for windows in which the table has no header. */
function SortChoice() {
  const columns = [{ name: words.columns.name, sort: NAME_SORT }, ...COLUMNS].filter(
    ({ sort: order }) => order !== undefined,
  );
  return (
    <label class="runs-sort">
      <span class="visually-hidden">{words.sort}</span>
      <select
        value={sort.value}
        onChange={(event) => changeQuery({ sort: event.currentTarget.value })}
      >
        {columns.map((column) => (
          <>
            <option key={column.sort} value={column.sort}>
              {words.sortUp(column.name)}
            </option>
            <option key={`-${column.sort}`} value={`-${column.sort}`}>
              {words.sortDown(column.name)}
            </option>
          </>
        ))}
      </select>
    </label>
  );
}

export function Finder() {
  return (
    <search class="line grow runs-finder">
      <label class="runs-search">
        <span class="visually-hidden">{words.search}</span>
        <input
          type="search"
          maxLength={200}
          placeholder={words.searchHint}
          title={words.searchDoes}
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
        title={words.trashHint}
        onClick={() => changeQuery({ isTrash: !isTrash.peek() })}
      >
        {words.trash}
      </button>
    </search>
  );
}
